#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>

#include <string>

#include "bench/standard_frame.hpp"

namespace pilothouse::bench {

constexpr const char* kCameraFrame = "camera_depth_optical_frame";
constexpr double kFrameRate = 30.0;  // [Hz]

/// What a camera sends; each is made anew, as a driver does.
sensor_msgs::Image::Ptr imageOf(const StandardFrame& frame);
sensor_msgs::CameraInfo::Ptr infoOf(const StandardFrame& frame);
sensor_msgs::PointCloud2::Ptr cloudOf(const StandardFrame& frame);

/// Publishes the standard frame, as depth or as a 16-byte cloud.
class CameraSource {
 public:
  CameraSource(ros::NodeHandle handle, bool depth);
  bool hasListener() const { return publisher_.getNumSubscribers() > 0; }
  /// One frame, stamped right before it goes out, when all its bytes are ready.
  void publish();
  /// Frames at kFrameRate. @return how many.
  int publishFor(double seconds);

 private:
  StandardFrame frame_;
  bool depth_;
  ros::Publisher publisher_, info_;
};

}  // namespace pilothouse::bench
