#pragma once

#include <nav_msgs/Odometry.h>
#include <tf2_ros/transform_listener.h>

#include <optional>
#include <string>

#include "core/motion/pose_history.hpp"

namespace pilothouse {

/// Where the base is and was, in any frame: odometry and the newest transform. For where it is,
/// neither may be old.
class BasePose {
 public:
  struct Limits {
    double odometry = 0.5;   ///< since it came in [s]
    double transform = 1.0;  ///< since its stamp [s]
  };
  BasePose(std::string odom_frame, Limits limits)
      : odom_frame_(std::move(odom_frame)), limits_(limits) {}

  /// @return why it was refused; empty: it was not.
  std::string take(const nav_msgs::Odometry& odometry);
  /// By the newest odometry. @param fault why there is none.
  std::optional<Pose2> in(const std::string& frame, std::string& fault) const;
  /// At a time [s], by the odometry about it. @param fault why there is none.
  std::optional<Pose2> at(double stamp, const std::string& frame, std::string& fault) const;
  /// T_frame_from, of whatever age. @param fault why there is none.
  std::optional<Pose2> transform(const std::string& frame, const std::string& from,
                                 std::string& fault) const;

 private:
  std::optional<Pose2> T_frame_odom(const std::string& frame, std::string& fault) const;

  std::string odom_frame_;
  Limits limits_;
  std::optional<Pose2> T_odom_base_;
  PoseHistory history_;
  double arrival_ = 0.0;  ///< steady clock [s]
  tf2_ros::Buffer transforms_;
  tf2_ros::TransformListener listener_{transforms_};
};

}  // namespace pilothouse
