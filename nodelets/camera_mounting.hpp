#pragma once

#include <std_msgs/Header.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <Eigen/Geometry>
#include <cstdint>
#include <string>

#include "core/cloud/checked.hpp"

namespace pilothouse {

/// Where the camera sits on the robot, by tf: T_base_camera at a message's stamp. Static transforms
/// hold at any stamp. Where a moving chain is not known at that stamp (yet, or any more), the
/// newest known transform is taken, because a camera is bolted to its robot; that is counted.
/// Without a chain between the frames there is no answer: never an identity.
class CameraMounting {
 public:
  explicit CameraMounting(std::string base_frame)
      : base_frame_(std::move(base_frame)), listener_(buffer_) {}

  const std::string& baseFrame() const { return base_frame_; }
  /// @return T_base_camera for the header's frame, finite; or a reason that names both frames.
  Checked<Eigen::Isometry3f> find(const std_msgs::Header& header);
  /// How many answers were the newest transform instead of the one at the stamp.
  std::uint64_t outOfTime() const { return out_of_time_; }
  /// Forgets moving transforms; static ones stay. For when time jumps.
  void reset() { buffer_.clear(); }

 private:
  std::string base_frame_;
  tf2_ros::Buffer buffer_;
  tf2_ros::TransformListener listener_;
  std::uint64_t out_of_time_ = 0;
};

}  // namespace pilothouse
