// What the goal navigator does when it is stuck: plans anew, looks round, backs off, rests.
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/navigation/goal_navigator.hpp"

namespace pilothouse {
namespace {

using Eigen::Vector2d;

constexpr double kElsewhere = 0.5;     // stuck so far from the last time is another case [m]
constexpr double kLongestLook = 6.0;   // [s]
constexpr double kLongestBack = 12.0;  // [s]
constexpr double kAhead = 0.35;        // so far ahead is where it does not get on [m]
constexpr double kAvoided = 0.05;      // radius of what is kept off there [m]
constexpr double kLookShare = 0.8;     // of the trusted distance it looks from
constexpr int kSides = 16;             // that it may look from ...
constexpr int kMostPlans = 5;          // ... ways are sought to so many of them at most
constexpr double kOtherSide = 0.6;     // places so far apart are two sides [m]
constexpr double kFarthestLook = 5.0;  // it drives so far to look [m]
constexpr double kSlowDrive = 0.2;     // there [m/s]
constexpr double kOwnSize = 0.3;       // what is seen hides itself within this [m]

/// Whether nothing that is known stands between, but for what is looked at itself.
bool sees(const MapCells& map, const Vector2d& from, const Vector2d& to) {
  const Vector2d way = to - from;
  const int steps = static_cast<int>(2.0 * way.norm() / map.cell_size) + 1;
  for (int i = 0; i <= steps; ++i) {
    const Vector2d place = from + way * i / steps;
    if ((to - place).norm() < kOwnSize) return true;
    if (map.at(map.column(place.x()), map.row(place.y())) == MapCell::kOccupied) return false;
  }
  return true;
}

}  // namespace

/// The next measure of the ladder: plan anew, look round, back off, rest; some times over.
void GoalNavigator::stuck(const NavigationInput& input) {
  const double off = (input.pose->position() - goal_.place).norm();
  if (off < stuck_off_ - kElsewhere) {
    tries_ = 0;
    measure_ = Measure::kReplan;
    stuck_off_ = off;
    looked_from_.clear();
  }
  if (!text_.empty()) stuck_by_ = text_;
  got_on_ = turned_on_ = now_;
  if (measure_ == Measure::kReplan) {
    measure_ = Measure::kLook;
    // Nothing known is in the way: the same way would come out again.
    const bool same = !path_.empty() && planner_.free(judged(*input.pose));
    if (!same && (replan(input) || ended())) return;
  }
  if (measure_ == Measure::kLook) {
    measure_ = Measure::kBack;
    if (path_.empty() && (lookAtBlock(input) || goPastHidden(input))) return;
    if (ended()) return;
    // At what holds it the executor has looked; later all round is tried too.
    const bool looked = hasLooked(input) && tries_ == 0;
    if (parameters_.look_angle > 0.0 && !looked) return lookRound(input);
  }
  if (measure_ == Measure::kBack) {
    measure_ = Measure::kRest;
    if (path_.empty() && goPastHidden(input)) return;
    if (ended()) return;
    if (tries_ > 0) avoidHere();  // not before it was held there again
    if (backOff(input)) return;
  }
  measure_ = Measure::kReplan;
  if (++tries_ < parameters_.tries) {
    replan(input);
    return;
  }
  const Plan plan = seek(input).plan;
  const std::string tried = "gave up after " + std::to_string(tries_) + " tries: ";
  fail(tried + (plan ? stuck_by_ : textOf(plan.why)), plan.nearest);
}

/// To one side, to the other, and back; each a route of one point.
void GoalNavigator::lookRound(const NavigationInput& input) {
  looks_ = 0;
  look_from_ = *input.pose;
  lookTo(0);
}

void GoalNavigator::lookTo(int look) {
  const double turns[] = {parameters_.look_angle, -parameters_.look_angle, 0.0};
  looks_ = look;
  path_.clear();
  send({look_from_}, wrapped(look_from_.heading + turns[look]));
  enter(NavigationPhase::kLooking);
  longest_ = kLongestLook;
  text_ = "looks round: " + stuck_by_;
}

/// What the way that there would be without any marks comes to first.
std::optional<Vector2d> GoalNavigator::blockOf(const NavigationInput& input) {
  const Plan clean = planner_.planAmong({}, request(input));
  if (!clean) return std::nullopt;
  std::vector<Vector2d> places;
  for (const Pose2& pose : clean.poses) places.push_back(pose.position());
  const Route route(places, planner_.parameters().corners);
  std::optional<Vector2d> first;
  double least = HUGE_VAL;
  for (const Planner::Mark& mark : planner_.marks()) {
    if (mark.kind == MapCell::kThreshold || !mark.place.allFinite()) continue;
    const Route::Foot foot = route.nearest(mark.place, 0.0, route.length());
    if (foot.distance > planner_.check().ample() + mark.radius || foot.way >= least) continue;
    least = foot.way;
    first = mark.place;
  }
  return first;
}

/// Whatever is near is not forgotten, for the camera does not see the floor right before the robot:
/// it drives to where it sees what is in the way, each time from another side.
bool GoalNavigator::lookAtBlock(const NavigationInput& input) {
  const auto block = blockOf(input);
  if (!block) return false;
  const double off = kLookShare * parameters_.trust_distance;
  std::vector<Vector2d> places;
  for (int i = 0; i < kSides; ++i) {
    const double bearing = 2.0 * 3.14159265358979 * i / kSides;
    places.emplace_back(*block + off * Vector2d(std::cos(bearing), std::sin(bearing)));
  }
  const Vector2d here = input.pose->position();
  std::sort(places.begin(), places.end(), [&here](const Vector2d& a, const Vector2d& b) {
    return (a - here).norm() < (b - here).norm();
  });
  int plans = 0;
  for (const Vector2d& place : places) {
    const bool again = std::any_of(
        looked_from_.begin(), looked_from_.end(),
        [&place](const Vector2d& other) { return (other - place).norm() < kOtherSide; });
    if (again || !sees(planner_.map(), place, *block)) continue;
    if (++plans > kMostPlans) return false;
    if (drivesToLook(input, place, *block)) return true;
  }
  return false;
}

bool GoalNavigator::drivesToLook(const NavigationInput& input, const Vector2d& from,
                                 const Vector2d& block) {
  const Vector2d way = block - from;
  const double heading = std::atan2(way.y(), way.x());
  Plan plan = planner_.plan({*input.pose, from, heading});
  if (!plan || plan.length > kFarthestLook) return false;
  looked_from_.push_back(from);
  longest_ = kLongestBack + plan.length / kSlowDrive;
  lay(std::move(plan.poses));
  send(path_, heading);
  enter(NavigationPhase::kBacking);
  text_ = "goes to look at what is in the way: " + stuck_by_;
  return true;
}

/// What may stand where nobody can look keeps nobody from a goal to which no other way leads; the
/// speed limiter lets the robot go slowly there.
bool GoalNavigator::goPastHidden(const NavigationInput& input) {
  if (!planner_.hides()) return false;
  planner_.ignoreHidden(true);
  if (replan(input)) return true;
  if (!ended()) planner_.ignoreHidden(false);
  return ended();
}

/// It is held on a way that is free by all that the planner knows: round a corner, say, nearer than
/// the speed limiter lets it turn. The next way leads elsewhere, where there is one.
void GoalNavigator::avoidHere() {
  if (path_.empty()) return;
  const Vector2d place = route_.at(std::min(route_.length(), way_ + kAhead)).position;
  if ((place - goal_.place).norm() < planner_.check().ample() + kAhead) return;
  avoided_.push_back({place, kAvoided, MapCell::kOccupied});
}

/// To where it came from.
bool GoalNavigator::backOff(const NavigationInput& input) {
  if (!(parameters_.back_distance > 0.0)) return false;
  double least = parameters_.back_distance;
  for (auto place = trail_.rbegin(); place != trail_.rend(); ++place) {
    const double off = (place->position() - input.pose->position()).norm();
    if (off < least) continue;
    if (least > 3.0 * parameters_.back_distance) return false;
    least += 0.5 * parameters_.back_distance;
    Plan plan = planner_.plan({*input.pose, place->position(), std::nullopt});
    if (!plan || plan.length > 4.0 * parameters_.back_distance) continue;
    lay(std::move(plan.poses));
    send(path_, std::nullopt);
    enter(NavigationPhase::kBacking);
    longest_ = kLongestBack;
    text_ = "backs off: " + stuck_by_;
    return true;
  }
  return false;
}

/// Whether the way of the manoeuvre still is, and the robot is on it.
bool GoalNavigator::isFree(const NavigationInput& input) {
  if (path_.empty()) return true;  // it turns where it stands
  if (off_way_ > kOffWay) return false;
  if (revision_ == planner_.revision()) return true;
  revision_ = planner_.revision();
  return planner_.free(rest(*input.pose));
}

void GoalNavigator::manoeuvre(const NavigationInput& input) {
  if (input.halted) since_ = now_;
  const bool looking = phase_ == NavigationPhase::kLooking;
  const bool over = now_ - since_ > longest_;
  if (!over && isFree(input) && !isHeard(input, ExecutorReport::kReached)) return;
  if (looking && looks_ < 2) return lookTo(looks_ + 1);
  got_on_ = turned_on_ = now_;
  replan(input);
}

}  // namespace pilothouse
