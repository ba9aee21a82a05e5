#include "core/planning/planner.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace pilothouse {
namespace {

using Eigen::Vector2d;

constexpr int kAttempts = 16;     // searches, each with more places closed
constexpr int kTightenings = 60;  // of corners, in one of them
constexpr double kCorner = 0.3;   // a corner is led round by points so far before and behind [m]
constexpr double kShortestLeg = 0.1;    // legs beside a corner are not made shorter [m]
constexpr double kNearCorner = 0.6;     // touching farther from a corner is not its fault [m]
constexpr double kFarthestGoal = 50.0;  // from the map's middle [m]
constexpr std::size_t kShutIn = 50000;  // cells, 125 m^2: a robot may be shut in there
constexpr int kEscapeWeight = 2 * CostField::kPlain;

const PlanningParameters& checked(const PlanningParameters& parameters) {
  std::string all;
  for (const auto& fault : validate(parameters)) all += (all.empty() ? "" : "\n") + fault;
  if (!all.empty()) throw std::invalid_argument(all);
  return parameters;
}

double angleOf(const Vector2d& v) {
  return std::atan2(v.y(), v.x());
}

}  // namespace

Planner::Planner(const PlanningParameters& parameters, const Footprint& footprint, BaseKind base)
    : parameters_(checked(parameters)),
      base_(base),
      check_(footprint, 0.5 * parameters.clearance),
      bare_(footprint, 0.0),
      field_(parameters, check_.inscribed(), check_.ample()) {}

/// Whether the robot turns into the way.
bool Planner::turns() const {
  return base_ == BaseKind::kDifferential || parameters_.heading == HeadingMode::kFree;
}

bool Planner::markSeen(std::vector<Mark> marks, const Pose2& pose) {
  if (!hasMap() || !pose.finite() || ignores_hidden_) return mark(marks);
  return mark(hidden_.behind(std::move(marks), pose, map_, check_.circumscribed()));
}

bool Planner::hides() const {
  const std::vector<Mark>& all = marks();
  return std::any_of(all.begin(), all.end(), [](const Mark& mark) { return mark.hidden; });
}

void Planner::ignoreHidden(bool ignored) {
  ignores_hidden_ = ignored;
  if (!ignored) return;
  hidden_.clear();
  std::vector<Mark> seen = marks();
  seen.erase(std::remove_if(seen.begin(), seen.end(), [](const Mark& mark) { return mark.hidden; }),
             seen.end());
  mark(seen);
}

Plan Planner::planAmong(const std::vector<Mark>& marks, const PlanRequest& request) {
  const std::uint32_t revision = map_.revision();
  const std::vector<Mark> all = map_.marks();
  mark(marks);
  Plan found = plan(request);
  mark(all);
  map_.setRevision(revision);
  return found;
}

/// Round where it stands too near to things the search may go where it is no nearer to them, at a
/// price: along what it stands beside the robot need not turn, as it would have to for the straight
/// way off.
void Planner::openRound(const Pose2& start) {
  const MapCells& map = this->map();
  const Cell from{map.column(start.x), map.row(start.y)};
  const double least = field_.clearance(from.x, from.y) - map.cell_size;
  const int reach = static_cast<int>(parameters_.escape / map.cell_size);
  for (int y = from.y - reach; y <= from.y + reach; ++y) {
    for (int x = from.x - reach; x <= from.x + reach; ++x) {
      if (!map.contains(x, y) || field_.weight(x, y) != 0) continue;
      const bool own = x == from.x && y == from.y;
      const bool near = std::hypot(x - from.x, y - from.y) <= reach;
      if (!own && (!near || field_.blocked(x, y) || field_.clearance(x, y) < least)) continue;
      field_.set(x, y, kEscapeWeight);
      altered_.include(x, y);
    }
  }
}

/// Marks the place nearest to the goal that can be reached: in rings round it.
void Planner::fail(NoWay why, const PlanRequest& request, const PlanEnds& ends, Plan& plan) {
  plan.why = why;
  if (!ends.has_start) return;
  const Vector2d low(map().centreX(0), map().centreY(0));
  const Vector2d high(map().centreX(map().size_x - 1), map().centreY(map().size_y - 1));
  const Vector2d goal = request.goal.cwiseMax(low).cwiseMin(high);
  const Cell middle{map().column(goal.x()), map().row(goal.y())};
  reach_.spread(field_, ends.start);
  double least = HUGE_VAL;
  const auto look = [&](int x, int y) {
    if (!map().contains(x, y) || !reach_.holds(field_, {x, y})) return;
    const Vector2d place(map().centreX(x), map().centreY(y));
    const double off = (place - request.goal).norm();
    if (off >= least) return;
    least = off;
    plan.nearest = place;
  };
  const int farthest = std::max(map().size_x, map().size_y);
  // What lies in a ring is at least as far from the goal's cell; the cut to the map adds the same
  // to all.
  const double spare = (goal - request.goal).norm() + map().cell_size;
  for (int ring = 0; ring <= farthest && ring * map().cell_size <= least + spare; ++ring) {
    for (int i = -ring; i <= ring; ++i) {
      look(middle.x + i, middle.y - ring);
      look(middle.x + i, middle.y + ring);
      look(middle.x - ring, middle.y + i);
      look(middle.x + ring, middle.y + i);
    }
  }
}

/// The search's way, pulled straight, as points of the map's frame.
void Planner::lay(const PlanRequest& request, const PlanEnds& ends, Plan& plan) {
  search_.trace(cells_);
  smoother_.smooth(field_, cells_, grid_points_);
  points_.clear();
  points_.push_back(request.start.position());
  plan.cost = 0.0;
  for (std::size_t i = 0; i < grid_points_.size(); ++i) {
    const bool end = i == 0 || i + 1 == grid_points_.size();
    if (i > 0) {
      plan.cost +=
          map().cell_size * straightCost(field_, grid_points_[i - 1], grid_points_[i], HUGE_VAL);
    }
    if (end && !(i == 0 && ends.escaped)) continue;
    points_.push_back(Vector2d(map().origin_x, map().origin_y) + map().cell_size * grid_points_[i]);
  }
  points_.push_back(request.goal);
}

/// Leads the way round a corner by points nearer to it, so that less of it is cut.
bool Planner::tighten(const Vector2d& touch) {
  std::size_t corner = 0;
  double least = kNearCorner;
  for (std::size_t i = 1; i + 1 < points_.size(); ++i) {
    const double off = (points_[i] - touch).norm();
    if (off < least) {
      least = off;
      corner = i;
    }
  }
  if (corner == 0) return false;
  const Vector2d here = points_[corner];
  const Vector2d in = points_[corner - 1] - here, out = points_[corner + 1] - here;
  const auto at = points_.begin() + static_cast<std::ptrdiff_t>(corner);
  const bool after = out.norm() > 2.0 * kShortestLeg, before = in.norm() > 2.0 * kShortestLeg;
  const Vector2d behind = here + std::min(0.5, kCorner / out.norm()) * out;
  const Vector2d ahead = here + std::min(0.5, kCorner / in.norm()) * in;
  if (after) points_.insert(at + 1, behind);
  if (before) points_.insert(points_.begin() + static_cast<std::ptrdiff_t>(corner), ahead);
  return after || before;
}

/// @return where the way touches though all was done to lead it round; nothing: it is free.
std::optional<Pose2> Planner::touchOf(const PlanRequest& request, Plan& plan) {
  for (int i = 0;; ++i) {
    const Route route(points_, parameters_.corners);
    plan.length = route.length();
    const OutlineWalk walk{request.start.heading, turns(), request.heading};
    const auto touch = firstTouch(check_, field_, map(), route, walk);
    if (!touch || i == kTightenings || !tighten(touch->position())) return touch;
  }
}

/// Keeps the search off a place where the outline would touch.
void Planner::close(const Pose2& touch, int attempt, const PlanEnds& ends) {
  const int reach = 1 + attempt / 3;
  const Cell middle{map().column(touch.x), map().row(touch.y)};
  for (int y = middle.y - reach; y <= middle.y + reach; ++y) {
    for (int x = middle.x - reach; x <= middle.x + reach; ++x) {
      const Cell cell{x, y};
      if (!map().contains(x, y) || cell == ends.start || cell == ends.goal) continue;
      field_.set(x, y, 0);
      altered_.include(x, y);
    }
  }
}

void Planner::restore() {
  if (!altered_.empty()) field_.update(map(), altered_);
  altered_ = {};
}

void Planner::putPoses(const PlanRequest& request, Plan& plan) const {
  plan.poses.clear();
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Vector2d& place = points_[i];
    double heading = request.start.heading;
    if (turns() && i + 1 < points_.size()) {
      heading = angleOf(points_[i + 1] - place);
    } else if (turns() && i > 0) {
      heading = plan.poses.back().heading;
    }
    if (i + 1 == points_.size()) heading = request.heading.value_or(heading);
    plan.poses.push_back({place.x(), place.y(), heading});
  }
}

/// @return why it found none.
NoWay Planner::search(const PlanRequest& request, const PlanEnds& ends, Plan& plan) {
  // Shut in, the robot need not wait until all that the goal can reach was searched.
  const bool shut_in = reach_.spread(field_, ends.start, kShutIn);
  if (shut_in && !reach_.holds(field_, ends.goal)) return NoWay::kWalledOff;
  std::optional<Pose2> touch;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const bool found = search_.find(field_, ends.start, ends.goal).has_value();
    plan.expanded += search_.expanded();
    if (!found) break;
    lay(request, ends, plan);
    touch = touchOf(request, plan);
    if (!touch) return NoWay::kNone;
    close(*touch, attempt, ends);
  }
  if (!touch) return NoWay::kWalledOff;
  const bool at_goal = (touch->position() - request.goal).norm() < check_.circumscribed();
  return at_goal ? NoWay::kGoalTight : NoWay::kTooNarrow;
}

void Planner::setMap(const MapCells& map) {
  // What lies outside was never seen either.
  if (parameters_.unknown == UnknownFloor::kNever && map.cell_size > 0.0) {
    map_.surround(static_cast<int>(std::ceil(field_.reach() / map.cell_size)));
  }
  map_.take(map, field_);
}

/// Floor that nobody has seen goes on outside the map: a goal there can be driven to.
void Planner::coverGoal(const Vector2d& goal) {
  if (parameters_.unknown == UnknownFloor::kNever || !hasMap() || !goal.allFinite()) return;
  const MapCells& map = this->map();
  const Vector2d middle(map.origin_x + 0.5 * map.size_x * map.cell_size,
                        map.origin_y + 0.5 * map.size_y * map.cell_size);
  if (!((goal - middle).cwiseAbs().maxCoeff() < kFarthestGoal)) return;
  if (!map.contains(map.column(goal.x()), map.row(goal.y()))) map_.cover(goal, field_);
}

/// What lies between what start and goal can reach, looked for from the lesser side.
NoWay Planner::parts(const PlanEnds& ends) {
  goal_reach_.spread(field_, ends.goal);
  return reach_.count() < goal_reach_.count() ? whatParts(map(), field_, ends.start, goal_reach_)
                                              : whatParts(map(), field_, ends.goal, reach_);
}

Plan Planner::plan(const PlanRequest& request) {
  Plan plan;
  coverGoal(request.goal);
  const PlanEnds ends = findEnds(field_, map(), check_, request, parameters_.escape);
  if (ends.why != NoWay::kNone) {
    fail(ends.why, request, ends, plan);
    return plan;
  }
  if (ends.escaped) {
    PlanEnds own = ends;
    own.start = {map().column(request.start.x), map().row(request.start.y)};
    own.escaped = false;
    openRound(request.start);
    plan.why = search(request, own, plan);
    restore();
  }
  if (!ends.escaped || !plan) plan.why = search(request, ends, plan);
  if (plan) {
    restore();
    putPoses(request, plan);
    return plan;
  }
  fail(plan.why, request, ends, plan);
  restore();
  if (plan.why == NoWay::kWalledOff) plan.why = parts(ends);
  plan.length = plan.cost = 0.0;
  return plan;
}

bool Planner::touchesNothing(const FootprintCheck& check, const std::vector<Pose2>& poses) const {
  if (poses.empty() || !hasMap()) return true;
  std::vector<Vector2d> points;
  for (const Pose2& pose : poses) points.push_back(pose.position());
  const OutlineWalk walk{poses.front().heading, turns(), std::nullopt};
  return !firstTouch(check, field_, map(), Route(points, parameters_.corners), walk);
}

}  // namespace pilothouse
