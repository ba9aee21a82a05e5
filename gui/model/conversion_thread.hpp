#pragma once

#include <sensor_msgs/CameraInfo.h>

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "gui/model/console_state.hpp"
#include "gui/model/conversions.hpp"

namespace pilothouse::gui {

/// Turns the newest messages into pictures, away from the ROS and GUI threads.
class ConversionThread {
 public:
  explicit ConversionThread(ConsoleState& state);
  ~ConversionThread();

  Mailbox<sensor_msgs::Image> depth;
  Mailbox<sensor_msgs::PointCloud2> cloud;
  Mailbox<sensor_msgs::Image> colour;
  Mailbox<sensor_msgs::CompressedImage> coded;
  Mailbox<FloorGrid> floor;
  Mailbox<ObjectList> objects, standing;
  Guarded<boost::shared_ptr<const sensor_msgs::CameraInfo>> info;
  /// Whether the cloud stands in for the depth and for the colour picture.
  std::atomic<bool> cloud_as_depth{false}, cloud_as_colour{false};

  void wake();

 private:
  void run();
  void convertCamera();
  template <class Message, class Picture, class Convert>
  void convert(Mailbox<Message>& box, Feed<Picture>& feed, Convert&& function);

  ConsoleState& state_;
  DepthConverter depth_converter_;
  std::mutex mutex_;
  std::condition_variable ready_;
  bool pending_ = false, stopping_ = false;
  std::thread thread_;
};

}  // namespace pilothouse::gui
