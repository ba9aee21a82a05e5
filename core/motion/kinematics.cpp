#include "core/motion/kinematics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pilothouse {
namespace {

using Eigen::Vector2d;

constexpr double kQuarterTurn = 1.5707963267948966;
/// A steered wheel that shall move slower than this keeps its angle [m/s]: the direction of next to
/// nothing is noise.
constexpr double kStill = 1e-7;

std::vector<Wheel> wheelsOf(const BaseParameters& base) {
  const double x = 0.5 * base.wheelbase, y = 0.5 * base.track;
  if (base.kind == BaseKind::kDifferential) return {{"left", {0.0, y}}, {"right", {0.0, -y}}};
  return {{"front_left", {x, y}},
          {"front_right", {x, -y}},
          {"rear_left", {-x, y}},
          {"rear_right", {-x, -y}}};
}

/// The point's velocity when the base moves by `twist`.
Vector2d velocityAt(const Vector2d& point, const Twist2& twist) {
  return {twist.vx - twist.w * point.y(), twist.vy + twist.w * point.x()};
}

/// The wheel rolling by `velocity`, steered the shorter way from `now`.
WheelState steeredFor(const Vector2d& velocity, const WheelState& now) {
  const double speed = velocity.norm();
  const double kept = std::isfinite(now.angle) ? wrapped(now.angle) : 0.0;
  if (speed < kStill) return {kept, 0.0};
  const double angle = std::atan2(velocity.y(), velocity.x());
  if (std::abs(wrapped(angle - kept)) <= kQuarterTurn) return {angle, speed};
  return {wrapped(angle + 2.0 * kQuarterTurn), -speed};
}

}  // namespace

Kinematics::Kinematics(const BaseParameters& base) : kind_(base.kind), wheels_(wheelsOf(base)) {
  const double half_track = 0.5 * base.track, half_base = 0.5 * base.wheelbase;
  if (kind_ == BaseKind::kDifferential) {
    rows_.row(0) << 1.0, 0.0, -half_track;
    rows_.row(1) << 1.0, 0.0, half_track;
    inverse_rows_ << 0.5, 0.5, 0.0, 0.0,  //
        0.0, 0.0, 0.0, 0.0,               //
        -1.0 / base.track, 1.0 / base.track, 0.0, 0.0;
  } else if (kind_ == BaseKind::kOmnidirectional) {
    const double arm = half_base + half_track;
    rows_ << 1.0, -1.0, -arm,  //
        1.0, 1.0, arm,         //
        1.0, 1.0, -arm,        //
        1.0, -1.0, arm;
    // The columns are orthogonal.
    inverse_rows_ = rows_.transpose();
    for (int i = 0; i < 3; ++i) inverse_rows_.row(i) /= rows_.col(i).squaredNorm();
  }
}

WheelStates Kinematics::inverse(const Twist2& twist, const WheelStates& now) const {
  const Twist2 wanted = twist.finite() ? twist : Twist2{};
  WheelStates states;
  if (steered()) {
    for (std::size_t i = 0; i < wheels_.size(); ++i) {
      states[i] = steeredFor(velocityAt(wheels_[i].position, wanted), now[i]);
    }
    return states;
  }
  const Eigen::Vector4d speeds = rows_ * Eigen::Vector3d(wanted.vx, wanted.vy, wanted.w);
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    states[i].speed = speeds[static_cast<Eigen::Index>(i)];
  }
  return states;
}

double Kinematics::alignment(const WheelStates& now, const WheelStates& wanted) const {
  double least = 1.0;
  if (!steered()) return least;
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    least = std::min(least, std::cos(wrapped(wanted[i].angle - now[i].angle)));
  }
  return std::max(0.0, least);
}

WheelMotion Kinematics::forward(const WheelStates& states) const {
  if (steered()) return forwardSteered(states);
  Eigen::Vector4d speeds = Eigen::Vector4d::Zero();
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    speeds[static_cast<Eigen::Index>(i)] = states[i].speed;
  }
  const Eigen::Vector3d twist = inverse_rows_ * speeds;
  const double residual = (rows_ * twist - speeds).norm();
  return {{twist[0], twist[1], twist[2]},
          residual / std::sqrt(static_cast<double>(wheels_.size()))};
}

/// Two equations a wheel. The wheels lie evenly round the origin, so that the translation is the
/// mean of their velocities and the turn the mean of what is left, weighed by the lever arm.
WheelMotion Kinematics::forwardSteered(const WheelStates& states) const {
  std::array<Vector2d, 4> velocities;
  Vector2d sum(0.0, 0.0);
  double turn = 0.0, arms = 0.0;
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    const Vector2d& p = wheels_[i].position;
    velocities[i] =
        states[i].speed * Vector2d(std::cos(states[i].angle), std::sin(states[i].angle));
    sum += velocities[i];
    turn += p.x() * velocities[i].y() - p.y() * velocities[i].x();
    arms += p.squaredNorm();
  }
  const auto count = static_cast<double>(wheels_.size());
  const Twist2 twist{sum.x() / count, sum.y() / count, turn / arms};
  double squares = 0.0;
  for (std::size_t i = 0; i < wheels_.size(); ++i) {
    squares += (velocities[i] - velocityAt(wheels_[i].position, twist)).squaredNorm();
  }
  return {twist, std::sqrt(squares / count)};
}

Twist2 withinLimits(const Twist2& twist, const BaseParameters& base) {
  if (!twist.finite()) return {};
  Twist2 possible = twist;
  if (base.kind == BaseKind::kDifferential) possible.vy = 0.0;
  const double excess =
      std::max(possible.linear() / base.max_speed, std::abs(possible.w) / base.max_turn_rate);
  if (!(excess > 1.0)) return possible;
  // Speeds near the largest double overflow on the way; nobody means them.
  if (!std::isfinite(excess)) return {};
  // A hair less, so that rounding never breaks a limit.
  return ((1.0 - 4.0 * std::numeric_limits<double>::epsilon()) / excess) * possible;
}

}  // namespace pilothouse
