#pragma once

#include <algorithm>
#include <deque>

#include "core/motion/kinematics.hpp"
#include "core/motion/motion_executor.hpp"

namespace pilothouse {

constexpr double kStep = 0.02;  ///< [s]

inline BaseParameters baseOf(BaseKind kind) {
  BaseParameters base;
  base.kind = kind;
  base.wheelbase = kind == BaseKind::kDifferential ? 0.0 : 0.4;
  return base;
}

/// A base: a command arrives late, the speed follows it with a lag and bounded accelerations, as
/// behind a speed limiter.
class SimulatedBase {
 public:
  SimulatedBase(const BaseParameters& base, const Pose2& pose) : base_(base), pose_(pose) {}
  void step(const Twist2& wanted) {
    late_.push_back(withinLimits(wanted, base_));
    const Twist2 command = late_.front();
    if (late_.size() > 4) late_.pop_front();
    approach(command_.vx, command.vx, 0.5);
    approach(command_.vy, command.vy, 0.5);
    approach(command_.w, command.w, 1.5);
    const double share = kStep / (kStep + base_.lag);
    twist_ = twist_ + share * (command_ - twist_);
    pose_ = advanced(pose_, twist_, kStep);
  }
  const Pose2& pose() const { return pose_; }
  void put(const Pose2& pose) { pose_ = pose; }
  const Twist2& twist() const { return twist_; }

 private:
  static void approach(double& value, double target, double rate) {
    value += std::clamp(target - value, -rate * kStep, rate * kStep);
  }
  BaseParameters base_;
  Pose2 pose_;
  Twist2 command_, twist_;
  std::deque<Twist2> late_;
};

}  // namespace pilothouse
