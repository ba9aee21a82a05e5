#pragma once

#include <nav_msgs/Odometry.h>
#include <tf2_ros/transform_listener.h>

#include <optional>
#include <string>

#include "core/motion/planar.hpp"

namespace pilothouse {

/// Where the base is, in any frame: newest odometry and newest transform. Neither may be old.
class BasePose {
 public:
  explicit BasePose(std::string odom_frame) : odom_frame_(std::move(odom_frame)) {}

  /// @return why it was refused; empty: it was not.
  std::string take(const nav_msgs::Odometry& odometry);
  /// @param fault why there is none.
  std::optional<Pose2> in(const std::string& frame, std::string& fault) const;
  /// T_frame_from, of whatever age. @param fault why there is none.
  std::optional<Pose2> transform(const std::string& frame, const std::string& from,
                                 std::string& fault) const;

 private:
  std::string odom_frame_;
  std::optional<Pose2> T_odom_base_;
  double arrival_ = 0.0;  ///< steady clock [s]
  tf2_ros::Buffer transforms_;
  tf2_ros::TransformListener listener_{transforms_};
};

}  // namespace pilothouse
