#pragma once

#include "core/motion/kinematics.hpp"

namespace pilothouse::sim {

/// The drives of a base: what its wheels do about a commanded twist. The command is kept within the
/// base's limits and forgotten when it is older than command_timeout; the twist follows it with
/// bounded acceleration along a straight line in (vx, vy, w), so that a robot that brakes in an arc
/// stays on it; steering turns at its rate, and the drives lag.
class WheelDrive {
 public:
  explicit WheelDrive(const BaseParameters& base) : base_(base), kinematics_(base) {}

  /// @param twist not finite: refused, as if nothing had come. @param now simulated time [s].
  void command(const Twist2& twist, double now);
  /// Forgets the command at once; the base brakes as its limits allow.
  void forgetCommand() { commanded_ = false; }
  /// Advances by `dt` [s] to `now`.
  void step(double now, double dt);
  /// The wheels stand at once, as when the robot has run into something.
  void block();

  const Kinematics& kinematics() const { return kinematics_; }
  const WheelStates& wheels() const { return wheels_; }
  /// How the base would move if no wheel slipped.
  Twist2 twist() const { return kinematics_.forward(wheels_).twist; }
  bool hasCommand() const { return commanded_; }

 private:
  void approach(const Twist2& target, double dt);
  void steer(const WheelStates& wanted, double dt);

  BaseParameters base_;
  Kinematics kinematics_;
  Twist2 wanted_;           ///< commanded, within the limits
  bool commanded_ = false;  ///< and not too old
  double commanded_at_ = 0.0;
  Twist2 set_;  ///< what the drives are told at this instant
  double alignment_ = 1.0;
  WheelStates wheels_;
};

}  // namespace pilothouse::sim
