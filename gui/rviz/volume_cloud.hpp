#pragma once

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>
#include <sensor_msgs/PointCloud2.h>

#include <mutex>
#include <string>

#include "gui/model/depth_ramp.hpp"

namespace pilothouse::gui {

/// Passes the voxels of volume_points on, coloured by height and at most kMostBoxes of them, on its
/// own thread.
class VolumeCloud {
 public:
  static constexpr std::size_t kMostBoxes = 20000;

  /// What came last.
  struct State {
    std::string frame;   ///< empty: nothing yet
    float edge = 0.05F;  ///< of the boxes [m]
  };

  VolumeCloud();
  /// Where the boxes are published.
  std::string topic() const { return publisher_.getTopic(); }
  State state() const;

 private:
  void receive(const sensor_msgs::PointCloud2ConstPtr& cloud);

  DepthRamp ramp_;
  mutable std::mutex mutex_;
  State state_;
  ros::CallbackQueue queue_;
  ros::NodeHandle node_;
  ros::Publisher publisher_;
  ros::Subscriber subscriber_;
  ros::AsyncSpinner spinner_;
};

}  // namespace pilothouse::gui
