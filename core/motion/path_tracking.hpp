#pragma once

#include "core/motion/planar.hpp"
#include "core/motion/route.hpp"

namespace pilothouse {

/// Where a base that can move sideways looks while it drives.
enum class HeadingMode {
  kFree,  ///< it turns into the direction of travel, so that the camera looks ahead
  kKept,  ///< it drives into any direction without turning
};

/// What a tracker may ask of the base.
struct TrackingLimits {
  double max_speed = 0.5;          ///< [m/s], 0.02..10
  double max_turn_rate = 0.8;      ///< [rad/s], 0.05..10
  double deceleration = 0.3;       ///< slows towards stops and bends with this [m/s^2], 0.05..5
  double turn_deceleration = 0.8;  ///< [rad/s^2], 0.05..20
  double lateral = 0.4;            ///< acceleration sideways in bends [m/s^2], 0.05..10
  double reaction = 0.3;           ///< from a command to the motion [s], 0..2
};

/// Follows a route by its nearest place: the course is the way's direction a moment ahead, turned
/// towards the way by an angle that grows with the distance from it (as Samson 1995, "Control of
/// chained systems: application to path following"). Bases that cannot move sideways turn in place
/// while the course is far off their heading.
class PathTracker {
 public:
  PathTracker(const TrackingLimits& limits, bool sideways, HeadingMode heading)
      : limits_(limits),
        turns_to_course_(!sideways || heading == HeadingMode::kFree),
        sideways_(sideways) {}

  /// @param kept heading that a base keeps which does not turn to its course [rad].
  /// @param way of the foot of `pose` on the route; @param stop where it must stand next [m].
  Twist2 follow(const Route& route, double way, double stop, const Pose2& pose, double kept);
  /// Turns in place to `heading`.
  Twist2 turnTo(double heading, const Pose2& pose) const;
  /// Straight to a point that is near, for bases that can move sideways; `kept` as above.
  Twist2 slideTo(const Eigen::Vector2d& point, const Pose2& pose, double kept) const;
  /// Highest speed at `way` from which the next stop and bends can be met [m/s].
  double speedAt(const Route& route, double way, double stop) const;
  void reset() { turning_ = false; }

 private:
  double turnRate(double angle) const;

  TrackingLimits limits_;
  bool turns_to_course_, sideways_;
  bool turning_ = false;
};

}  // namespace pilothouse
