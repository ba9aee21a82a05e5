#pragma once

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>
#include <sensor_msgs/PointCloud2.h>

#include <string>

namespace pilothouse::gui {

/// Passes a cloud on with at most kMostPoints points, on its own thread: librviz draws on the GUI
/// thread and takes a fifth of a second for a whole cloud without a graphics card.
class ThinnedCloud {
 public:
  static constexpr std::size_t kMostPoints = 9000;

  ThinnedCloud(const std::string& from, const std::string& to);
  /// Where the thinned cloud is published.
  std::string topic() const { return publisher_.getTopic(); }

 private:
  void receive(const sensor_msgs::PointCloud2ConstPtr& cloud);

  ros::CallbackQueue queue_;
  ros::NodeHandle node_;
  ros::Publisher publisher_;
  ros::Subscriber subscriber_;
  ros::AsyncSpinner spinner_;
};

}  // namespace pilothouse::gui
