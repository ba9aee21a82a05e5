#include "core/motion/path_tracking.hpp"

#include <algorithm>
#include <cmath>

namespace pilothouse {
namespace {

using Eigen::Vector2d;

constexpr double kTurnAbove = 0.7;    // [rad] off the course: stand and turn ...
constexpr double kTurnUntil = 0.1;    // ... to within this
constexpr double kApproach = 2.0;     // the course turns by atan of so much a metre beside [1/m]
constexpr double kSteepest = 1.1;     // ... to this at most [rad]
constexpr double kHeadingGain = 1.8;  // [1/s]
constexpr double kSlideGain = 1.0;    // [1/s]
constexpr double kSettle = 0.15;      // so near a stop the distance beside is not made good [m]

double angleOf(const Vector2d& v) {
  return std::atan2(v.y(), v.x());
}

/// From where a stop within `distance` is still met: v^2 / 2a + v T = distance.
double stoppable(double distance, double reaction, double deceleration) {
  if (!(distance > 0.0)) return 0.0;
  return deceleration * (std::sqrt(reaction * reaction + 2.0 * distance / deceleration) - reaction);
}

}  // namespace

double PathTracker::turnRate(double angle) const {
  const double rate = std::min(limits_.max_turn_rate, stoppable(std::abs(angle), limits_.reaction,
                                                                limits_.turn_deceleration));
  return std::copysign(rate, angle);
}

double PathTracker::speedAt(const Route& route, double way, double stop) const {
  const double a = limits_.deceleration;
  double speed =
      std::min(limits_.max_speed, stoppable(stop - way, limits_.reaction, limits_.deceleration));
  const double horizon = speed * limits_.reaction + 0.5 * speed * speed / a;
  route.curvatures(way, way + horizon, [&](double begin, double curvature) {
    if (!(curvature > 0.0)) return;
    const double bend =
        std::min(0.8 * limits_.max_turn_rate / curvature, std::sqrt(limits_.lateral / curvature));
    const double free = std::max(0.0, begin - way - speed * limits_.reaction);
    speed = std::min(speed, std::sqrt(bend * bend + 2.0 * a * free));
  });
  return speed;
}

Twist2 PathTracker::turnTo(double heading, const Pose2& pose) const {
  return {0.0, 0.0, turnRate(wrapped(heading - pose.heading))};
}

Twist2 PathTracker::slideTo(const Vector2d& point, const Pose2& pose, double kept) const {
  Vector2d velocity = kSlideGain * pose.toBase(point);
  const double most = std::min(limits_.max_speed, 0.15);
  if (velocity.norm() > most) velocity *= most / velocity.norm();
  const double w = turns_to_course_ ? 0.0 : turnRate(wrapped(kept - pose.heading));
  return {velocity.x(), velocity.y(), w};
}

Twist2 PathTracker::follow(const Route& route, double way, double stop, const Pose2& pose,
                           double kept) {
  const double speed = speedAt(route, way, stop);
  const Route::Place foot = route.at(way);
  // A hair before the stop: behind it the way goes elsewhere.
  const double preview = std::min(way + speed * limits_.reaction, stop - 1e-6);
  const Route::Place ahead = route.at(std::max(way, preview));
  const Vector2d beside = pose.position() - foot.position;
  const double left = foot.direction.x() * beside.y() - foot.direction.y() * beside.x();
  const double near = std::clamp((stop - way) / kSettle, 0.0, 1.0);
  const double correction = -near * std::clamp(std::atan(kApproach * left), -kSteepest, kSteepest);
  const double along = angleOf(ahead.direction);
  const double course = along + correction;

  double heading_error = wrapped(kept - pose.heading);
  if (turns_to_course_) heading_error = wrapped((sideways_ ? along : course) - pose.heading);
  if (!turns_to_course_ || std::abs(heading_error) < kTurnUntil) turning_ = false;
  if (turns_to_course_ && std::abs(heading_error) > kTurnAbove) turning_ = true;
  if (turning_) return {0.0, 0.0, turnRate(heading_error)};

  Twist2 twist;
  const double c = std::cos(heading_error);
  const double slowed = turns_to_course_ ? speed * c * c : speed;
  if (sideways_) {
    const double direction = course - pose.heading;
    twist.vx = slowed * std::cos(direction);
    twist.vy = slowed * std::sin(direction);
  } else {
    twist.vx = slowed;
  }
  const double bend = turns_to_course_ ? slowed * ahead.curvature : 0.0;
  twist.w = bend + kHeadingGain * heading_error;
  const double excess = std::abs(twist.w) / limits_.max_turn_rate;
  return excess > 1.0 ? (1.0 / excess) * twist : twist;
}

}  // namespace pilothouse
