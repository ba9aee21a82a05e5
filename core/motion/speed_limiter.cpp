#include "core/motion/speed_limiter.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/motion/kinematics.hpp"
#include "core/motion/power_limit.hpp"

namespace pilothouse {
namespace {

using Eigen::Vector2d;

constexpr double kStand = 0.02;   // slower limits mean standing [m/s]
constexpr double kGoOn = 0.05;    // the robot goes on when the limit has risen to this [m/s]
constexpr double kStep = 0.10;    // of looking along the path [m]
constexpr double kBeyond = 0.15;  // what must have been looked at beyond the way to stand still [m]
constexpr double kHalfSeen = 0.5;  // share of places that must have been looked at

std::string joined(const std::vector<std::string>& faults) {
  std::string text;
  for (const auto& fault : faults) text += (text.empty() ? "" : "\n") + fault;
  return text;
}

void requireSound(const std::vector<std::string>& faults) {
  if (!faults.empty()) throw std::invalid_argument(joined(faults));
}

void lower(PathLimit& limit, double speed, LimitCause cause, double distance, const Obstacle& by) {
  if (speed >= limit.speed) return;
  limit.speed = speed;
  limit.cause = cause;
  limit.distance = distance;
  limit.source = by.source;
  limit.remembered = by.remembered;
  limit.position = by.position.cast<double>();
}

}  // namespace

SpeedLimiter::SpeedLimiter(const AvoidanceParameters& avoidance, const BaseParameters& base,
                           const Footprint& footprint)
    : avoidance_(avoidance),
      base_(base),
      footprint_(footprint),
      regulator_(avoidance, footprint.farthestFrom(Vector2d::Zero())) {
  requireSound(validate(avoidance));
  requireSound(validate(base));
}

void SpeedLimiter::setParameters(const AvoidanceParameters& avoidance) {
  requireSound(validate(avoidance));
  avoidance_ = avoidance;
  regulator_.setParameters(avoidance);
}

void SpeedLimiter::reset() {
  regulator_.reset();
  held_ = false;
}

/// Speed now that can be brought down to `speed` within `distance` [m].
double SpeedLimiter::slowingTo(double speed, double distance) const {
  const double way = std::max(0.0, distance - speed * avoidance_.latency);
  return std::sqrt(speed * speed + 2.0 * avoidance_.acceleration * way);
}

/// What the base can always brake the path speed with, travelling and turning together.
double SpeedLimiter::decelerationAlong(const Twist2& unit) const {
  return std::min(base_.deceleration / std::max(1e-6, unit.linear()),
                  base_.turn_acceleration / std::max(1e-6, std::abs(unit.w)));
}

void SpeedLimiter::holdBefore(const Obstacle& object, const SweptPath::Contact& contact,
                              const Braking& brake, PathLimit& limit) const {
  limit.obstacle_distance = std::min(limit.obstacle_distance, contact.distance);
  const double free = contact.distance - brake.stop;
  const double power = base_.max_speed * powerLimit(free, avoidance_.n, avoidance_.k);
  // The touching point goes `speed` of the path's speed, so its way is that share of the path's.
  const double braking =
      brakingBound(free / std::max(1e-3, contact.speed), avoidance_.latency, brake.deceleration);
  lower(limit, power, LimitCause::kObstacle, contact.distance, object);
  lower(limit, braking, LimitCause::kBraking, contact.distance, object);
}

void SpeedLimiter::goSlowly(const Obstacle& object, const SweptPath::Contact& contact,
                            PathLimit& limit) const {
  if (object.kind == CellClass::kThreshold) {
    const double speed = slowingTo(avoidance_.threshold_speed, contact.distance);
    return lower(limit, speed, LimitCause::kThreshold, contact.distance, object);
  }
  limit.potential_distance = std::min(limit.potential_distance, contact.distance);
  const double power = base_.max_speed * powerLimit(contact.distance, avoidance_.n, avoidance_.k);
  lower(limit, std::max(avoidance_.beside_speed, power), LimitCause::kPotential, contact.distance,
        object);
}

void SpeedLimiter::meetObjects(const SweptPath& path, const Twist2& unit,
                               Surroundings& surroundings, PathLimit& limit) const {
  // Turning in place needs less room: what is touched first goes slowly, and sideways.
  const double travel = std::min(1.0, 2.0 * unit.linear());
  const double stop = avoidance_.turn_clearance +
                      travel * std::max(0.0, avoidance_.stop_distance - avoidance_.turn_clearance);
  const Braking brake{stop, decelerationAlong(unit)};
  for (Obstacle& object : surroundings.objects) {
    const auto contact =
        path.meet(object.position.cast<double>(), 0.5 * static_cast<double>(object.size));
    object.relevance = contact.relevance;
    if (contact.relevance == Relevance::kOther) continue;
    if (object.kind == CellClass::kThreshold) {
      // Driven over, so only what lies under the way matters, and nothing of it stops.
      if (contact.relevance == Relevance::kInTheWay) goSlowly(object, contact, limit);
      object.relevance =
          contact.relevance == Relevance::kInTheWay ? Relevance::kPotential : Relevance::kOther;
    } else if (contact.relevance == Relevance::kInTheWay) {
      holdBefore(object, contact, brake, limit);
    } else {
      goSlowly(object, contact, limit);
    }
  }
}

// The places that the leading part of the outline will stand on, as far as the robot goes until it
// stands still from the speed that is allowed so far.
void SpeedLimiter::lookAhead(const SweptPath& path, const Twist2& unit, const Looked& looked,
                             PathLimit& limit) const {
  const double deceleration = decelerationAlong(unit);
  const double speed = std::min(limit.speed, base_.max_speed);
  if (!looked || speed <= avoidance_.unseen_speed) return;
  const double until = speed * avoidance_.latency + speed * speed / (2.0 * deceleration) + kBeyond;
  for (double way = kStep; way < until + kStep; way += kStep) {
    const Pose2 pose = path.poseAfter(way), before = path.poseAfter(way - kStep);
    int places = 0, seen = 0;
    const auto visit = [&](const Vector2d& place) {
      const Vector2d moved = pose * place - before * place;
      const Vector2d outward = pose * place - pose.position();
      if (moved.dot(outward) <= 0.0) return;  // not the leading side
      ++places;
      if (looked(pose * place)) ++seen;
    };
    for (const auto& edge : footprint_.edges()) {
      visit(edge.from);
      visit(0.5 * (edge.from + edge.to));
    }
    if (seen >= kHalfSeen * places) continue;
    const double most = slowingTo(avoidance_.unseen_speed, way - kStep);
    const double allowed = avoidance_.unseen_speed > 0.0
                               ? most
                               : brakingBound(way - kStep, avoidance_.latency, deceleration);
    if (allowed >= limit.speed) return;
    limit.speed = allowed;
    limit.cause = LimitCause::kUnseen;
    limit.distance = way;
    limit.source = -1;
    limit.remembered = false;
    limit.position = pose.position();
    return;
  }
}

PathLimit SpeedLimiter::limitAlong(const Twist2& twist, Surroundings& surroundings,
                                   const Looked& looked) {
  PathLimit limit;
  if (!twist.finite()) {
    limit.cause = LimitCause::kBadCommand;
    limit.speed = 0.0;
    return limit;
  }
  const double speed = pathSpeed(twist);
  const Twist2 unit = speed > 0.0 ? (1.0 / speed) * twist : Twist2{};
  const SweptPath path(footprint_, twist, avoidance_.margin, avoidance_.look_ahead);
  meetObjects(path, unit, surroundings, limit);
  if (speed > 0.0) lookAhead(path, unit, looked, limit);
  return limit;
}

LimitedCommand SpeedLimiter::step(const LimiterInput& input, Surroundings& surroundings,
                                  const Looked& looked) {
  LimitedCommand result;
  const bool finite = input.wanted.finite();
  const bool current = input.command_age <= avoidance_.input_timeout;  // NaN: not current
  const Twist2 target = finite && current ? withinLimits(input.wanted, base_) : Twist2{};
  result.wanted = pathSpeed(target);
  result.measured = input.measured.finite() ? pathSpeed(input.measured)
                                            : std::numeric_limits<double>::quiet_NaN();

  Twist2 next = regulator_.approach(target, input.dt);
  double speed = pathSpeed(next);
  // Standing, the words on the map and the graph are about the way that is wanted; or straight on.
  const Twist2 way = speed > 0.0 ? next : (result.wanted > 0.0 ? target : Twist2{1.0, 0.0, 0.0});
  result.limit = limitAlong(way, surroundings, looked);
  PathLimit& limit = result.limit;

  const bool stands = limit.speed < (held_ ? kGoOn : kStand);
  held_ = stands;
  if (stands) limit.speed = 0.0;
  const bool seeing = input.perception_age <= avoidance_.input_timeout;
  const bool knowing = input.odometry_age <= avoidance_.input_timeout;
  if (!finite || !seeing || !knowing) {
    limit.speed = 0.0;
    limit.cause = finite ? LimitCause::kStale : LimitCause::kBadCommand;
    limit.distance = std::numeric_limits<double>::quiet_NaN();
    limit.source = -1;
    limit.remembered = false;
  }
  result.command = regulator_.finish(next, speed, limit.speed, result.measured, input.dt);
  result.command = withinLimits(result.command, base_);
  result.limited = pathSpeed(result.command);
  if (limit.speed >= result.wanted && limit.speed > 0.0) limit.cause = LimitCause::kFree;
  return result;
}

}  // namespace pilothouse
