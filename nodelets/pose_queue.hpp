#pragma once

#include <tf2_ros/transform_listener.h>

#include <deque>
#include <functional>
#include <optional>
#include <string>

#include "core/motion/planar.hpp"
#include "nodelets/input_health.hpp"

namespace pilothouse {

/// Frames that wait until the base's pose at their stamp is known by tf. One thread at a time.
class PoseQueue {
 public:
  /// @return why the frame was refused; empty: it was not.
  using Use = std::function<std::string(const Pose2& T_map_base)>;

  PoseQueue(std::string map_frame, std::string base_frame)
      : map_frame_(std::move(map_frame)), base_frame_(std::move(base_frame)) {}

  /// The frame will be used by work(), in the order of coming, or refused where no pose comes in
  /// time.
  void add(const ros::Time& stamp, InputHealth& health, Use use);
  /// Uses what can be used by now.
  void work();
  void clear() { waiting_.clear(); }
  tf2_ros::Buffer& transforms() { return transforms_; }
  const std::string& mapFrame() const { return map_frame_; }
  const std::string& baseFrame() const { return base_frame_; }

 private:
  struct Waiting {
    ros::Time stamp;
    InputHealth::Clock::time_point arrival;
    InputHealth* health;
    Use use;
  };
  std::optional<Pose2> poseAt(const ros::Time& stamp, std::string& fault);

  std::string map_frame_, base_frame_;
  tf2_ros::Buffer transforms_;
  tf2_ros::TransformListener listener_{transforms_};
  std::deque<Waiting> waiting_;
};

}  // namespace pilothouse
