#include "core/motion/speed_regulator.hpp"

#include <algorithm>
#include <cmath>

namespace pilothouse {
namespace {

constexpr double kLeastStep = 1e-3, kLongestStep = 0.5;  // [s]
constexpr double kReached = 1e-4;                        // [m/s]
constexpr double kMostTrim = 0.2;                        // share of the commanded speed

double boundedStep(double dt) {
  return dt > kLeastStep ? std::min(dt, kLongestStep) : kLeastStep;  // NaN: the least
}

double sizeOf(const Twist2& t, double reach) {
  return std::sqrt(t.vx * t.vx + t.vy * t.vy + reach * reach * t.w * t.w);
}

}  // namespace

SpeedRegulator::SpeedRegulator(const AvoidanceParameters& parameters, double reach)
    : parameters_(parameters), reach_(reach) {}

void SpeedRegulator::setParameters(const AvoidanceParameters& parameters) {
  parameters_ = parameters;
}

void SpeedRegulator::reset() {
  command_ = acceleration_ = {};
  integral_ = last_error_ = last_trim_ = 0.0;
}

Twist2 SpeedRegulator::approach(const Twist2& wanted, double dt) {
  dt = boundedStep(dt);
  const Twist2 target = wanted.finite() ? wanted : Twist2{};
  const Twist2 missing = target - command_;
  const double left = sizeOf(missing, reach_);
  const double most = parameters_.acceleration, jerk = parameters_.jerk;
  if (left <= kReached) {
    acceleration_ = {};
    return target;
  }
  // As fast as can still be taken back to nothing by the jerk when the target is reached, one step
  // from now on.
  const double step = jerk * dt;
  const double wish = std::min(most, std::sqrt(step * step + 2.0 * jerk * left) - step);
  const Twist2 change = (wish / left) * missing - acceleration_;
  const double size = sizeOf(change, reach_);
  acceleration_ = acceleration_ + (size > step ? step / size : 1.0) * change;
  const Twist2 next = command_ + dt * acceleration_;
  const Twist2 after = target - next;
  const bool past =
      after.vx * missing.vx + after.vy * missing.vy + reach_ * reach_ * after.w * missing.w < 0.0;
  if (past) acceleration_ = {};
  return past ? target : next;
}

Twist2 SpeedRegulator::finish(const Twist2& command, double speed, double limit, double measured,
                              double dt) {
  dt = boundedStep(dt);
  if (!(speed > 0.0) || !(limit > 0.0) || !command.finite()) {
    reset();
    return {};
  }
  const bool limited = limit < speed;
  if (limited) acceleration_ = {};
  const double allowed = std::min(speed, limit);
  command_ = (allowed / speed) * command;
  if (!std::isfinite(measured)) return command_;

  const double error = allowed - measured;
  const double raw = parameters_.kp * error + parameters_.ki * integral_ +
                     parameters_.kd * (error - last_error_) / dt;
  const double bound = kMostTrim * allowed;
  // It grows no faster than the command may; shrinking is free.
  const double trim =
      std::clamp(std::min(raw, last_trim_ + parameters_.acceleration * dt), -bound, bound);
  last_trim_ = trim;
  // Anti-windup: nothing is gathered while the output is held by its bound or by the limit.
  const bool held = raw != trim || (limited && error > 0.0);
  if (!held || raw * error < 0.0) integral_ += error * dt;
  last_error_ = error;
  return (std::min(allowed + trim, limit) / speed) * command;
}

}  // namespace pilothouse
