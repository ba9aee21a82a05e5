#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "core/motion/avoidance_parameters.hpp"
#include "core/motion/base_parameters.hpp"
#include "core/motion/footprint.hpp"
#include "core/motion/obstacle.hpp"
#include "core/motion/planar.hpp"
#include "core/motion/speed_regulator.hpp"
#include "core/motion/swept_path.hpp"

namespace pilothouse {

/// Why the robot may not go as wanted. As in the message SpeedLimit.
enum class LimitCause : std::uint8_t {
  kFree = 0,
  kObstacle = 1,
  kPotential = 2,
  kBraking = 3,
  kThreshold = 4,
  kUnseen = 5,
  kStale = 6,
  kBadCommand = 7,
};

/// How fast the robot may go along a path, and why.
struct PathLimit {
  LimitCause cause = LimitCause::kFree;
  double speed = std::numeric_limits<double>::infinity();      ///< path speed [m/s]
  double distance = std::numeric_limits<double>::quiet_NaN();  ///< free way to the cause [m]
  int source = -1;  ///< index into Surroundings::sources; -1: none
  bool remembered = false;
  Eigen::Vector2d position{std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::quiet_NaN()};   ///< base frame [m]
  double obstacle_distance = std::numeric_limits<double>::infinity();   ///< [m]
  double potential_distance = std::numeric_limits<double>::infinity();  ///< [m]
};

struct LimiterInput {
  double dt = 0.02;             ///< since the last step [s]
  Twist2 wanted;                ///< base frame
  double command_age = 0.0;     ///< [s]; beyond the input timeout the command counts as zero
  Twist2 measured;              ///< by odometry
  double odometry_age = 0.0;    ///< [s]
  double perception_age = 0.0;  ///< of the oldest sensor that safety needs [s]
};

struct LimitedCommand {
  Twist2 command;  ///< goes out
  PathLimit limit;
  double wanted = 0.0, limited = 0.0;  ///< path speeds [m/s]
  double measured = 0.0;               ///< [m/s]; NaN: unknown
};

/// Keeps a wanted command from touching anything: corridor, power limits, braking bound,
/// thresholds, unseen ground, then acceleration, jerk and PID. v, sideways v and w are scaled
/// together, so the path keeps its shape.
class SpeedLimiter {
 public:
  /// Where something has looked, base frame now; null: everywhere.
  using Looked = std::function<bool(const Eigen::Vector2d&)>;

  /// @throws std::invalid_argument listing every fault of the parameters.
  SpeedLimiter(const AvoidanceParameters& avoidance, const BaseParameters& base,
               const Footprint& footprint);
  void setParameters(const AvoidanceParameters& avoidance);

  /// How fast along the path of `twist`. @param surroundings relevance of every object is set.
  PathLimit limitAlong(const Twist2& twist, Surroundings& surroundings, const Looked& looked);
  /// One step; the surroundings are those of input.now.
  LimitedCommand step(const LimiterInput& input, Surroundings& surroundings, const Looked& looked);
  void reset();

  const AvoidanceParameters& parameters() const { return avoidance_; }
  /// Path speed of a twist [m/s].
  double pathSpeed(const Twist2& twist) const { return SweptPath::speedOf(footprint_, twist); }

 private:
  struct Braking {
    double stop;          ///< distance before things at which the robot stands [m]
    double deceleration;  ///< of the path speed [m/s^2]
  };
  void meetObjects(const SweptPath& path, const Twist2& unit, Surroundings& surroundings,
                   PathLimit& limit) const;
  void holdBefore(const Obstacle& object, const SweptPath::Contact& contact, const Braking& braking,
                  PathLimit& limit) const;
  void goSlowly(const Obstacle& object, const SweptPath::Contact& contact, PathLimit& limit) const;
  void lookAhead(const SweptPath& path, const Twist2& unit, const Looked& looked,
                 PathLimit& limit) const;
  double decelerationAlong(const Twist2& unit) const;
  double slowingTo(double speed, double distance) const;

  AvoidanceParameters avoidance_;
  BaseParameters base_;
  Footprint footprint_;
  SpeedRegulator regulator_;
  bool held_ = false;  ///< stands before something: goes on only when it is a little farther
};

}  // namespace pilothouse
