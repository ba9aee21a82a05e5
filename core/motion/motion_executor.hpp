#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "core/motion/base_parameters.hpp"
#include "core/motion/path_tracking.hpp"
#include "core/motion/route.hpp"

namespace pilothouse {

struct ExecutorParameters {
  TrackingLimits limits;  ///< never more than the base's own
  CornerParameters corners;
  HeadingMode heading = HeadingMode::kFree;
  double position_tolerance = 0.03;  ///< at the end [m], 0.005..1
  double heading_tolerance = 0.03;   ///< at the end, where a heading is given [rad], 0.005..1
  double patience = 0.5;        ///< held so long by something remembered it looks again [s], 0..600
  double back_distance = 0.35;  ///< goes back so far to look [m], 0..2
  double back_speed = 0.15;     ///< [m/s], 0.01..1
  int looks = 3;                ///< so often at most before it waits for good, 0..100
};

/// Calls visit(key, value, low, high) for every number of the parameters; `looks` is an int.
template <class Parameters, class Visit>
void forEachExecutorParameter(Parameters& p, Visit visit) {
  visit("max_speed", p.limits.max_speed, 0.02, 10.0);
  visit("max_turn_rate", p.limits.max_turn_rate, 0.05, 10.0);
  visit("deceleration", p.limits.deceleration, 0.05, 5.0);
  visit("turn_deceleration", p.limits.turn_deceleration, 0.05, 20.0);
  visit("lateral", p.limits.lateral, 0.05, 10.0);
  visit("reaction", p.limits.reaction, 0.0, 2.0);
  visit("corner_radius", p.corners.radius, 0.0, 10.0);
  visit("max_cut", p.corners.max_cut, 0.0, 5.0);
  visit("position_tolerance", p.position_tolerance, 0.005, 1.0);
  visit("heading_tolerance", p.heading_tolerance, 0.005, 1.0);
  visit("patience", p.patience, 0.0, 600.0);
  visit("back_distance", p.back_distance, 0.0, 2.0);
  visit("back_speed", p.back_speed, 0.01, 1.0);
  visit("looks", p.looks, 0, 100);
}

/// Every fault, one line each naming key, value and range; empty when sound.
std::vector<std::string> validate(const ExecutorParameters& parameters);

/// Why the robot does not get on though it wants to.
enum class Hold {
  kNone,
  kSeen,        ///< the limiter holds it for something that a sensor sees, or for lack of input
  kRemembered,  ///< the limiter holds it for something that is only remembered
  kStopped,     ///< the stop gate lets nothing pass
};

struct ExecutorInput {
  double now = 0.0;  ///< [s], rising
  Pose2 pose;        ///< newest, in the route's frame
  Hold hold = Hold::kNone;
  std::string reason;                      ///< of the hold, in words
  std::optional<Eigen::Vector2d> held_by;  ///< where that is, base frame [m]
};

/// As in the message RouteState, without its refusals.
enum class ExecutorState { kIdle = 0, kDriving = 1, kWaiting = 2, kReached = 3 };

struct ExecutorOutput {
  Twist2 wanted;  ///< base frame, within the base's limits
  ExecutorState state = ExecutorState::kIdle;
  std::size_t target = 0;      ///< index of the point driven to
  double distance_left = 0.0;  ///< along the route; of a loop, to the end of this round [m]
  std::string text;  ///< waiting: why; driving: that it looks again at what holds it, else none
};

/// Drives the base along a route: newest pose in, wanted twist out. Progress is measured along the
/// route, so that loops and crossings are not cut short; when the pose jumps it goes on at the
/// nearest place that was still to come.
class MotionExecutor {
 public:
  /// @throws std::invalid_argument listing every fault of the parameters.
  MotionExecutor(const ExecutorParameters& parameters, const BaseParameters& base);

  /// From where it stands to the first point, then from point to point. None: cancels. Where it is
  /// within 10 cm of the route's first half metre it begins there: the robot drove on while the
  /// route was on its way.
  /// @param heading at the end; none: as it comes. Not looked at when `loop`.
  /// @param loop after the last point the first again, over and over.
  void drive(const std::vector<Eigen::Vector2d>& points, std::optional<double> heading, bool loop,
             const Pose2& pose);
  void cancel();
  ExecutorOutput step(const ExecutorInput& input);
  bool idle() const { return phase_ == Phase::kIdle; }
  const Route& route() const { return route_; }

 private:
  enum class Phase { kIdle, kFollow, kSettle, kBack, kLook, kReached };
  void layOut(const std::vector<Eigen::Vector2d>& points, bool loop, const Pose2& pose);
  void progress(const ExecutorInput& input);
  void remember(const Pose2& pose);
  void noticeHold(const ExecutorInput& input, ExecutorOutput& output);
  Twist2 follow(const Pose2& pose);
  Twist2 settle(const Pose2& pose);
  Twist2 goBack(const ExecutorInput& input);
  Twist2 look(const ExecutorInput& input);
  void enter(Phase phase, double now);

  ExecutorParameters parameters_;
  BaseParameters base_;
  PathTracker tracker_;
  Phase phase_ = Phase::kIdle;
  double phase_since_ = 0.0;
  Route route_;
  Eigen::Vector2d end_{0.0, 0.0};
  std::optional<double> end_heading_;
  std::size_t first_target_ = 0;  ///< how many points the route has before the first one given
  std::size_t points_ = 0;
  double kept_ = 0.0;    ///< heading that is kept [rad]
  double way_ = 0.0;     ///< how far along the route [m]
  double passed_ = 0.0;  ///< the last stop on it that was reached [m]
  std::optional<Pose2> last_pose_;
  double last_now_ = 0.0;
  std::deque<Eigen::Vector2d> trail_;  ///< where it came along, newest last
  double held_since_ = -1.0;           ///< negative: not held by something remembered
  int looked_ = 0;
  double looked_at_ = 0.0;  ///< way of the last look [m]
  Eigen::Vector2d back_from_{0.0, 0.0};
  std::optional<Eigen::Vector2d> look_at_;  ///< what is to be seen again, the route's frame
  double turned_since_ = 0.0;
  int approaches_ = 0;  ///< tries to come nearer to the end
};

}  // namespace pilothouse
