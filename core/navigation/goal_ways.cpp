// How the goal navigator finds ways: round what is seen, on to goals beyond, shorter ones.
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/navigation/goal_navigator.hpp"

namespace pilothouse {
namespace {

using Eigen::Vector2d;

constexpr double kMuchShorter = 0.85;    // a new way is taken when it is below this ...
constexpr double kShorterAtLeast = 0.2;  // ... and shorter by so much [m]
constexpr double kAhead = 3.0;           // goals beyond are planned to until the way is so long [m]
constexpr double kSlowing = 1.0;         // so near its end the executor slows [m]
constexpr double kStraight = 0.2;  // it drives along its way when it is turned less off it [rad]

std::vector<Vector2d> placesOf(const std::vector<Pose2>& poses) {
  std::vector<Vector2d> places;
  for (const Pose2& pose : poses) places.push_back(pose.position());
  return places;
}

}  // namespace

PlanRequest GoalNavigator::request(const NavigationInput& input) const {
  return {*input.pose, goal_.place, goal_.heading};
}

/// What is driven from now on.
void GoalNavigator::lay(std::vector<Pose2> poses) {
  path_ = std::move(poses);
  nearing_ = false;
  route_ = Route(placesOf(path_), planner_.parameters().corners);
  way_ = off_way_ = 0.0;
  ends_ = {route_.length()};
  revision_ = planner_.revision();
}

void GoalNavigator::take(Found found) {
  lay(std::move(found.plan.poses));
  nearing_ = found.nearing;
  settling_ = false;
  while (route_.length() < kAhead && lengthen()) {
  }
  best_left_ = left();
  got_on_ = turned_on_ = sought_ = now_;
  text_.clear();
  send(path_, endHeading());
  enter(NavigationPhase::kDriving);
}

/// A new way is not getting on.
void GoalNavigator::change(Found found) {
  const double got_on = got_on_, turned_on = turned_on_;
  ++plans_;
  take(std::move(found));
  got_on_ = got_on;
  turned_on_ = turned_on;
}

/// The one asked for at the goal that the way leads to.
std::optional<double> GoalNavigator::endHeading() const {
  return ends_.size() > 1 ? beyond_[ends_.size() - 2].heading : goal_.heading;
}

/// From here along the path to its end.
std::vector<Pose2> GoalNavigator::rest(const Pose2& pose) const {
  std::vector<Pose2> poses = {pose};
  for (std::size_t i = route_.empty() ? path_.size() - 1 : route_.target(way_); i < path_.size();
       ++i) {
    poses.push_back(path_[i]);
  }
  return poses;
}

/// The part of it that what is seen is trusted to judge, and no farther than that: the outline at
/// its end must not reach beyond.
std::vector<Pose2> GoalNavigator::judged(const Pose2& pose) const {
  std::vector<Pose2> poses = rest(pose);
  if (!nearing_) return poses;
  double left = std::max(0.1, parameters_.trust_distance - planner_.check().ample());
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const Vector2d leg = poses[i].position() - poses[i - 1].position();
    if (leg.norm() < left) {
      left -= leg.norm();
      continue;
    }
    const Vector2d end = poses[i - 1].position() + left / leg.norm() * leg;
    poses[i] = {end.x(), end.y(), poses[i].heading};
    poses.resize(i + 1);
  }
  return poses;
}

/// Round all that is seen. Where that leaves no way, round what is seen near by and what the map
/// has: farther off the camera errs more, people walk on, and from nearer it is seen better.
GoalNavigator::Found GoalNavigator::seek(const NavigationInput& input) {
  if (!avoided_.empty()) {
    std::vector<Planner::Mark> marks = planner_.marks();
    marks.insert(marks.end(), avoided_.begin(), avoided_.end());
    Plan elsewhere = planner_.planAmong(marks, request(input));
    if (elsewhere) return {std::move(elsewhere), false};
    avoided_.clear();
  }
  Found found{planner_.plan(request(input)), false};
  if (found.plan) return found;
  std::vector<Planner::Mark> near;
  for (const Planner::Mark& mark : planner_.marks()) {
    const double off = (mark.place - input.pose->position()).norm() - mark.radius;
    if (off < parameters_.trust_distance) near.push_back(mark);
  }
  if (near.size() == planner_.marks().size()) return found;
  return {planner_.planAmong(near, request(input)), true};
}

/// @return whether there is a way; it is under way then.
bool GoalNavigator::replan(const NavigationInput& input) {
  ++plans_;
  sought_ = now_;
  Found found = seek(input);
  if (found.plan) {
    take(std::move(found));
    return true;
  }
  const Plan& plan = found.plan;
  const Plan clean = planner_.planAmong({}, request(input));
  if (!clean) {
    fail(textOf(clean.why), clean.nearest);
    return false;
  }
  halt();
  nearest_ = plan.nearest;
  text_ = std::string("blocked: ") + textOf(plan.why);
  revision_ = planner_.revision();
  if (phase_ != NavigationPhase::kWaiting) enter(NavigationPhase::kWaiting);
  return false;
}

void GoalNavigator::goOn(const Goal& next, std::vector<Goal> beyond) {
  if (ends_.size() < 2 || path_.empty()) return start(next, std::move(beyond));
  goal_ = next;
  beyond_ = std::move(beyond);
  ends_.pop_front();
  best_left_ = left();
  got_on_ = turned_on_ = now_;
  forget();
}

/// Leads the way on to the goal beyond its end. @return false: there is none, or no way now.
bool GoalNavigator::lengthen() {
  if (path_.empty() || ends_.size() > beyond_.size()) return false;
  const Goal& next = beyond_[ends_.size() - 1];
  const Plan plan = planner_.plan({path_.back(), next.place, next.heading});
  if (!plan) return false;
  std::vector<Pose2> poses = path_;
  poses.insert(poses.end(), plan.poses.begin() + 1, plan.poses.end());
  // Each leg is free; the corner between them is rounded too.
  if (!planner_.roomy(poses)) return false;
  const Route route(placesOf(poses), planner_.parameters().corners);
  const double corner = planner_.parameters().corners.radius + 0.05;
  const double end = ends_.back();
  ends_.back() =
      route.nearest(path_.back().position(), std::max(0.0, end - corner), end + corner).way;
  path_ = std::move(poses);
  route_ = route;
  ends_.push_back(route_.length());
  return true;
}

/// Before it would slow towards an end at which it need not stand; where the way is straight, so
/// that the new order goes on as the old one did.
void GoalNavigator::lengthenInTime(const NavigationInput& input) {
  const double ahead = route_.length() - way_;
  if (path_.empty() || ends_.size() > beyond_.size() || ahead > kAhead) return;
  if (now_ - lengthened_ < kTryAgain) return;
  const Route::Place place = route_.at(way_);
  const double off = std::atan2(place.direction.y(), place.direction.x()) - input.pose->heading;
  if (ahead > kSlowing && (place.curvature != 0.0 || std::abs(wrapped(off)) > kStraight)) return;
  bool longer = false;
  lengthened_ = now_;
  while (route_.length() - way_ < kAhead && lengthen()) longer = true;
  if (longer) send(rest(*input.pose), endHeading());
}

void GoalNavigator::seekShorter(const NavigationInput& input) {
  sought_ = now_;
  if (!avoided_.empty()) return;  // it would be the one that it was held on
  Plan plan = planner_.plan(request(input));
  // A way through what was seen far off is left as soon as there is one round it.
  const double most =
      nearing_ ? HUGE_VAL : std::min(kMuchShorter * left(), left() - kShorterAtLeast);
  if (!plan || plan.length > most) return;
  change({std::move(plan), false});
}

/// Things turn out larger the more of them is seen: while it can still go by them, it goes by with
/// the room that a way should have.
void GoalNavigator::seekRoomier(const NavigationInput& input) {
  sought_ = now_;
  Found found = seek(input);
  if (found.plan) change(std::move(found));
}

}  // namespace pilothouse
