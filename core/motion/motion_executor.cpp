#include "core/motion/motion_executor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "core/motion/kinematics.hpp"

namespace pilothouse {
namespace {

using Eigen::Vector2d;

constexpr double kNear = 0.05;       // a single point nearer than this is where it stands [m]
constexpr double kBeside = 0.1;      // nearer than this to a route's beginning it is on it [m] ...
constexpr double kLate = 0.5;        // ... which is so long [m]
constexpr double kWindow = 0.5;      // progress is sought so far along the way [m]
constexpr double kAtStop = 0.01;     // so near a stop it has arrived [m]
constexpr double kTrailStep = 0.02;  // [m]
constexpr std::size_t kTrail = 60;
constexpr double kSameTrail = 0.1;     // so near its end the trail leads on [m]
constexpr double kHeldLook = 1.0;      // held so long while it turns to look it looks from here [s]
constexpr double kPullAhead = 0.12;    // going back it aims so far along the trail [m]
constexpr double kLookTime = 0.5;      // it stands so long to look [s]
constexpr double kLooksAt = 0.1;       // so near the camera's middle is well seen [rad]
constexpr double kLongestTurn = 6.0;   // [s]
constexpr double kFinerTime = 3.0;     // at the end it tries so long to be nearer than asked [s]
constexpr double kLongWait = 3.0;      // [s]
constexpr double kLongestBack = 10.0;  // [s]
constexpr double kForgetLooks = 0.5;   // got on so far since the last look: a new case [m]
constexpr int kApproaches = 5;

TrackingLimits limited(TrackingLimits limits, const BaseParameters& base) {
  limits.max_speed = std::min(limits.max_speed, base.max_speed);
  limits.max_turn_rate = std::min(limits.max_turn_rate, base.max_turn_rate);
  limits.deceleration = std::min(limits.deceleration, base.deceleration);
  limits.turn_deceleration = std::min(limits.turn_deceleration, base.turn_acceleration);
  return limits;
}

const ExecutorParameters& checked(const ExecutorParameters& parameters) {
  std::string all;
  for (const auto& fault : validate(parameters)) all += (all.empty() ? "" : "\n") + fault;
  if (!all.empty()) throw std::invalid_argument(all);
  return parameters;
}

}  // namespace

std::vector<std::string> validate(const ExecutorParameters& p) {
  std::vector<std::string> faults;
  forEachExecutorParameter(
      p, [&faults](const char* key, const auto& value, const auto& low, const auto& high) {
        if (value >= low && value <= high) return;
        std::ostringstream text;
        text << key << " is " << value << ", expected " << low << " to " << high;
        faults.push_back(text.str());
      });
  return faults;
}

MotionExecutor::MotionExecutor(const ExecutorParameters& parameters, const BaseParameters& base)
    : parameters_(checked(parameters)),
      base_(base),
      tracker_(limited(parameters.limits, base), base.kind != BaseKind::kDifferential,
               parameters.heading) {
  parameters_.limits = limited(parameters.limits, base);
}

void MotionExecutor::enter(Phase phase, double now) {
  phase_ = phase;
  phase_since_ = now;
  held_since_ = -1.0;
  tracker_.reset();
}

void MotionExecutor::cancel() {
  route_ = Route();
  phase_ = Phase::kIdle;
  points_ = 0;
}

/// A route is planned from where the robot was; until it comes the robot has moved on. To go to the
/// first point would be to turn round: it begins where the robot is along it. Not beyond a place at
/// which it must stop: a leg that comes back there would be taken for the one that leads there.
void MotionExecutor::layOut(const std::vector<Vector2d>& points, bool loop, const Pose2& pose) {
  const Vector2d place = pose.position();
  first_target_ = 0;
  route_ = Route(points, parameters_.corners, loop ? 0 : Route::kNoLoop);
  way_ = passed_ = 0.0;
  if (route_.empty()) {
    if ((points.front() - place).norm() <= kNear) return;
  } else {
    const auto foot = route_.nearest(place, 0.0, std::min(kLate, route_.stopAfter(0.0)));
    way_ = foot.way;
    if (foot.distance <= kBeside) return;
  }
  std::vector<Vector2d> all = {place};
  all.insert(all.end(), points.begin(), points.end());
  first_target_ = 1;
  route_ = Route(all, parameters_.corners, loop ? first_target_ : Route::kNoLoop);
  way_ = 0.0;
}

void MotionExecutor::drive(const std::vector<Vector2d>& points, std::optional<double> heading,
                           bool loop, const Pose2& pose) {
  cancel();
  if (points.empty()) return;
  layOut(points, loop, pose);
  points_ = points.size();
  end_ = points.back();
  end_heading_ = route_.loop() ? std::nullopt : heading;
  kept_ = pose.heading;
  last_pose_.reset();
  // A new order does not alter where it came along, unless it is of another frame or place.
  if (!trail_.empty() && (trail_.back() - pose.position()).norm() > kSameTrail) trail_.clear();
  looked_ = 0;
  approaches_ = 0;
  enter(route_.empty() ? Phase::kSettle : Phase::kFollow, last_now_);
}

/// Where along the route the robot is now.
void MotionExecutor::progress(const ExecutorInput& input) {
  const Vector2d place = input.pose.position();
  const double dt = std::clamp(input.now - last_now_, 0.0, 1.0);
  const bool jumped =
      last_pose_ && (place - last_pose_->position()).norm() > 0.3 + 3.0 * base_.max_speed * dt;
  last_pose_ = input.pose;
  if (route_.empty()) return;
  if (jumped) {
    trail_.clear();
    way_ = route_.nearest(place, way_, route_.loop() ? way_ + route_.round() : route_.length()).way;
    // Stops that lie behind the new place were passed by the jump.
    while (route_.stopAfter(passed_ + 1e-6) < way_) passed_ = route_.stopAfter(passed_ + 1e-6);
    return;
  }
  const double stop = route_.stopAfter(passed_ + 1e-6);
  const double from = std::max(passed_, way_ - kWindow);
  way_ = route_.nearest(place, from, std::min(stop, way_ + kWindow)).way;
}

void MotionExecutor::remember(const Pose2& pose) {
  const Vector2d place = pose.position();
  if (!trail_.empty() && (place - trail_.back()).norm() < kTrailStep) return;
  trail_.push_back(place);
  if (trail_.size() > kTrail) trail_.pop_front();
}

Twist2 MotionExecutor::follow(const Pose2& pose) {
  double stop = route_.stopAfter(passed_ + 1e-6);
  if (stop - way_ < kAtStop) {
    if (!route_.loop() && stop >= route_.length() - 1e-6) {
      enter(Phase::kSettle, last_now_);
      return settle(pose);
    }
    passed_ = way_ = stop + 1e-5;  // behind a sharp corner, on the next leg
    tracker_.reset();
    stop = route_.stopAfter(passed_ + 1e-6);
  }
  return tracker_.follow(route_, way_, stop, pose, kept_);
}

/// The last centimetres and the heading at the end.
Twist2 MotionExecutor::settle(const Pose2& pose) {
  const double gap = (end_ - pose.position()).norm();
  const bool sideways = base_.kind != BaseKind::kDifferential;
  // It may be held so near that it never gets nearer.
  const bool finer = sideways && last_now_ - phase_since_ < kFinerTime;
  if (gap > parameters_.position_tolerance ||
      (finer && gap > 0.4 * parameters_.position_tolerance)) {
    if (sideways && gap < 0.3) return tracker_.slideTo(end_, pose, kept_);
    if (gap > parameters_.position_tolerance && approaches_ < kApproaches) {
      // It missed the end, or was moved: from here to there anew.
      ++approaches_;
      route_ = Route({pose.position(), end_}, parameters_.corners);
      way_ = passed_ = 0.0;
      enter(Phase::kFollow, last_now_);
      return tracker_.follow(route_, 0.0, route_.length(), pose, kept_);
    }
  }
  const double heading = end_heading_.value_or(pose.heading);
  if (std::abs(wrapped(heading - pose.heading)) > 0.5 * parameters_.heading_tolerance) {
    return tracker_.turnTo(heading, pose);
  }
  enter(Phase::kReached, last_now_);
  return {};
}

/// Along the way it came, the camera to the front.
Twist2 MotionExecutor::goBack(const ExecutorInput& input) {
  const Vector2d place = input.pose.position();
  while (!trail_.empty() && (trail_.back() - place).norm() < kPullAhead) trail_.pop_back();
  const bool far = (place - back_from_).norm() >= parameters_.back_distance;
  if (far || trail_.empty() || input.now - phase_since_ > kLongestBack) {
    enter(Phase::kLook, input.now);
    turned_since_ = input.now;
    return {};
  }
  const Vector2d aim = input.pose.toBase(trail_.back());
  if (base_.kind != BaseKind::kDifferential) {
    const Vector2d velocity = parameters_.back_speed * aim.normalized();
    return {velocity.x(), velocity.y(), 0.0};
  }
  const double off = std::atan2(-aim.y(), -aim.x());
  // What lies beside cannot be backed to: it had turned in place.
  const double w = std::abs(off) < 0.7 ? parameters_.back_speed * 2.0 * off / kPullAhead : 0.0;
  return {-parameters_.back_speed, 0.0, std::clamp(w, -0.5, 0.5)};
}

/// Turns to what it remembers, so that it comes before the camera, and stands a while.
Twist2 MotionExecutor::look(const ExecutorInput& input) {
  const Vector2d seen = look_at_ ? input.pose.toBase(*look_at_) : Vector2d(1.0, 0.0);
  const double bearing = std::atan2(seen.y(), seen.x());
  if (input.hold == Hold::kNone) held_since_ = -1.0;
  if (input.hold != Hold::kNone && held_since_ < 0.0) held_since_ = input.now;
  const bool held = held_since_ >= 0.0 && input.now - held_since_ > kHeldLook;
  if (std::abs(bearing) > kLooksAt && input.now - phase_since_ < kLongestTurn && !held) {
    turned_since_ = input.now;
    return tracker_.turnTo(wrapped(input.pose.heading + bearing), input.pose);
  }
  if (input.now - turned_since_ > kLookTime) enter(Phase::kFollow, input.now);
  return {};
}

/// Held for long by what is only remembered, it goes back to look whether that is still there.
void MotionExecutor::noticeHold(const ExecutorInput& input, ExecutorOutput& output) {
  if (way_ > looked_at_ + kForgetLooks) looked_ = 0;
  if (input.hold != Hold::kRemembered) held_since_ = -1.0;
  if (input.hold == Hold::kNone) return;
  output.state = ExecutorState::kWaiting;
  output.text = input.reason;
  if (input.hold != Hold::kRemembered) return;
  if (held_since_ < 0.0) held_since_ = input.now;
  // Somebody may come and go before it: after a long wait it looks anew.
  if (looked_ >= parameters_.looks && input.now - held_since_ > kLongWait) looked_ = 0;
  if (looked_ >= parameters_.looks) {
    output.text += "; looked again " + std::to_string(looked_) + " times";
    return;
  }
  if (input.now - held_since_ < parameters_.patience) return;
  ++looked_;
  looked_at_ = way_;
  back_from_ = input.pose.position();
  look_at_.reset();
  if (input.held_by) look_at_ = input.pose * *input.held_by;
  enter(Phase::kBack, input.now);
}

ExecutorOutput MotionExecutor::step(const ExecutorInput& input) {
  ExecutorOutput output;
  if (phase_ == Phase::kIdle || !input.pose.finite()) return output;
  if (input.now < last_now_) enter(phase_, input.now);  // time was set back: waits begin afresh
  progress(input);
  last_now_ = input.now;
  output.state = ExecutorState::kDriving;
  if (phase_ == Phase::kFollow || phase_ == Phase::kSettle) noticeHold(input, output);
  switch (phase_) {
    case Phase::kIdle:
      break;
    case Phase::kFollow:
      remember(input.pose);
      output.wanted = follow(input.pose);
      break;
    case Phase::kSettle:
      output.wanted = settle(input.pose);
      break;
    case Phase::kBack:
      output.wanted = goBack(input);
      output.text = "goes back to look again at what it only remembers";
      break;
    case Phase::kLook:
      output.text = "looks again";
      output.wanted = look(input);
      break;
    case Phase::kReached:
      break;
  }
  if (phase_ == Phase::kReached) output.state = ExecutorState::kReached;
  output.wanted = withinLimits(output.wanted, base_);
  const std::size_t target = approaches_ > 0 ? points_ : route_.target(way_);
  output.target = std::min(target - std::min(target, first_target_), points_ - 1);
  const double end =
      route_.loop() && way_ > route_.length()
          ? route_.length() + route_.round() * std::ceil((way_ - route_.length()) / route_.round())
          : route_.length();
  output.distance_left = phase_ == Phase::kReached ? 0.0 : std::max(0.0, end - way_);
  return output;
}

}  // namespace pilothouse
