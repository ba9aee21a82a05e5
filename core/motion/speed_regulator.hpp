#pragma once

#include "core/motion/avoidance_parameters.hpp"
#include "core/motion/planar.hpp"

namespace pilothouse {

/// Brings a command towards a target with bounded acceleration and jerk, and holds the measured
/// speed to it by PID, as the original does. A limit on the speed is met at once: stopping bypasses
/// all.
class SpeedRegulator {
 public:
  /// @param reach of the footprint [m]: turning counts as w * reach beside vx and vy.
  SpeedRegulator(const AvoidanceParameters& parameters, double reach);
  void setParameters(const AvoidanceParameters& parameters);

  /// The next command before the limit. @param dt since the last step [s]; outside (0, 0.5] counts
  /// as the nearest of these bounds. A target that is not finite counts as zero.
  Twist2 approach(const Twist2& target, double dt);
  /// What goes out: `command`, trimmed by the PID on the measured path speed, never faster than the
  /// limit. The state follows, so that the next approach() starts from what was allowed.
  /// @param speed path speed of `command`; @param limit, @param measured (NaN: no trim) likewise
  /// [m/s].
  Twist2 finish(const Twist2& command, double speed, double limit, double measured, double dt);
  void reset();
  const Twist2& command() const { return command_; }

 private:
  AvoidanceParameters parameters_;
  double reach_;
  Twist2 command_;       ///< last, before the trim
  Twist2 acceleration_;  ///< of the command
  double integral_ = 0.0;
  double last_error_ = 0.0;
  double last_trim_ = 0.0;  ///< [m/s]
};

}  // namespace pilothouse
