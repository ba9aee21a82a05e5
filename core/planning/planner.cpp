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
constexpr double kShortestLeg = 0.1;  // legs beside a corner are not made shorter [m]
constexpr double kNearCorner = 0.6;   // touching farther from a corner is not its fault [m]
constexpr double kHeadingStep = 0.2;  // turning in place is looked at in such steps [rad]

const PlanningParameters& checked(const PlanningParameters& parameters) {
  std::string all;
  for (const auto& fault : validate(parameters)) all += (all.empty() ? "" : "\n") + fault;
  if (!all.empty()) throw std::invalid_argument(all);
  return parameters;
}

double angleOf(const Vector2d& v) {
  return std::atan2(v.y(), v.x());
}

/// Calls visit(pose) for the turn in place from one heading to another, the short way; ends where
/// that returns true. @return whether it did.
template <class Visit>
bool turning(const Vector2d& place, double from, double to, Visit visit) {
  const double turn = wrapped(to - from);
  const int steps = static_cast<int>(std::ceil(std::abs(turn) / kHeadingStep));
  for (int i = 1; i <= steps; ++i) {
    if (visit(Pose2{place.x(), place.y(), wrapped(from + turn * i / steps)})) return true;
  }
  return false;
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

void Planner::setMap(const MapCells& map) {
  field_.take(map);
  clean_ = map;
  map_ = map;
  marked_.clear();
  closed_ = {};
  ++revision_;
  mark(std::vector<Mark>(marks_));
}

/// Whether the map itself has something as grave there or beside: then it was seen a little off.
bool Planner::known(int x, int y, MapCell kind) const {
  for (int v = y - 1; v <= y + 1; ++v) {
    for (int u = x - 1; u <= x + 1; ++u) {
      if (clean_.at(u, v) >= kind) return true;
    }
  }
  return false;
}

bool Planner::mark(const std::vector<Mark>& marks) {
  marks_ = marks;
  marking_.clear();
  for (const Mark& mark : marks_) {
    if (!mark.place.allFinite() || !(mark.radius < 10.0)) continue;
    if (!(std::abs(mark.place.x()) < 1e5 && std::abs(mark.place.y()) < 1e5)) continue;
    const double radius = std::max(0.0, mark.radius);
    const auto kind = static_cast<std::size_t>(mark.kind);
    for (int y = map_.row(mark.place.y() - radius); y <= map_.row(mark.place.y() + radius); ++y) {
      for (int x = map_.column(mark.place.x() - radius); x <= map_.column(mark.place.x() + radius);
           ++x) {
        if (!map_.contains(x, y) || known(x, y, mark.kind)) continue;
        const Vector2d middle(map_.centreX(x), map_.centreY(y));
        const Vector2d off = (middle - mark.place).cwiseAbs();
        // The cell itself, and those whose middle the disc covers.
        const bool own = off.maxCoeff() <= 0.5 * map_.cell_size;
        if (own || off.norm() <= radius) marking_.push_back(map_.index(x, y) * 8 + kind);
      }
    }
  }
  std::sort(marking_.begin(), marking_.end());
  marking_.erase(std::unique(marking_.begin(), marking_.end()), marking_.end());
  if (marking_ == marked_) return false;
  putMarks();
  ++revision_;
  return true;
}

void Planner::putMarks() {
  CellWindow changed;
  const auto width = static_cast<std::size_t>(map_.size_x);
  const auto put = [&](std::size_t entry, bool on) {
    const std::size_t cell = entry / 8;
    map_.cells[cell] = on ? static_cast<MapCell>(entry % 8) : clean_.cells[cell];
    changed.include(static_cast<int>(cell % width), static_cast<int>(cell / width));
  };
  for (const std::size_t entry : marked_) {
    if (!std::binary_search(marking_.begin(), marking_.end(), entry)) put(entry, false);
  }
  // Rising: of two marks of one cell the graver comes last.
  for (const std::size_t entry : marking_) put(entry, true);
  marked_.swap(marking_);
  field_.update(map_, changed);
}

Plan Planner::planWithoutMarks(const PlanRequest& request) {
  const std::uint32_t revision = revision_;
  const std::vector<Mark> marks = marks_;
  mark({});
  Plan found = plan(request);
  mark(marks);
  revision_ = revision;
  return found;
}

/// From where it stands too near to something: the nearest cell that is free, straight.
std::optional<Cell> Planner::wayOut(const Pose2& start) const {
  const Cell from{map_.column(start.x), map_.row(start.y)};
  const int reach = static_cast<int>(std::ceil(parameters_.escape / map_.cell_size));
  std::optional<Cell> best;
  double least = parameters_.escape + map_.cell_size;
  for (int y = from.y - reach; y <= from.y + reach; ++y) {
    for (int x = from.x - reach; x <= from.x + reach; ++x) {
      if (!map_.contains(x, y) || field_.weight(x, y) == 0) continue;
      const Vector2d way = Vector2d(map_.centreX(x), map_.centreY(y)) - start.position();
      if (way.norm() >= least) continue;
      bool open = true;
      const int steps = static_cast<int>(2.0 * way.norm() / map_.cell_size) + 1;
      for (int i = 1; i < steps && open; ++i) {
        const Vector2d place = start.position() + way * i / steps;
        const Cell cell{map_.column(place.x()), map_.row(place.y())};
        // Its own cell may count as blocked: it stands there all the same.
        open = cell == from || !field_.blocked(cell.x, cell.y);
      }
      if (!open) continue;
      best = Cell{x, y};
      least = way.norm();
    }
  }
  return best;
}

NoWay Planner::judgeGoal(const PlanRequest& request, const Cell& goal) const {
  const MapCell kind = map_.at(goal.x, goal.y);
  if (kind == MapCell::kOccupied) return NoWay::kGoalOccupied;
  if (kind == MapCell::kDropOff) return NoWay::kGoalDropOff;
  if (field_.blocked(goal.x, goal.y)) return NoWay::kGoalUnknown;
  if (field_.weight(goal.x, goal.y) == 0) return NoWay::kGoalTight;
  if (!request.heading) return NoWay::kNone;
  const Pose2 end{request.goal.x(), request.goal.y(), *request.heading};
  return check_.fits(field_, map_, end) ? NoWay::kNone : NoWay::kGoalHeadingTight;
}

NoWay Planner::findEnds(const PlanRequest& request, Ends& ends) const {
  if (!hasMap()) return NoWay::kNoMap;
  const bool finite = request.start.finite() && request.goal.allFinite() &&
                      (!request.heading || std::isfinite(*request.heading));
  const auto within = [](const Vector2d& place) {
    return std::abs(place.x()) < 1e6 && std::abs(place.y()) < 1e6;
  };
  if (!finite || !within(request.start.position())) return NoWay::kNotFinite;
  ends.start = {map_.column(request.start.x), map_.row(request.start.y)};
  if (!map_.contains(ends.start.x, ends.start.y)) return NoWay::kStartOutside;
  ends.has_start = field_.weight(ends.start.x, ends.start.y) != 0;
  if (!ends.has_start) {
    const auto out = wayOut(request.start);
    if (!out) return NoWay::kStartBlocked;
    ends.start = *out;
    ends.has_start = ends.escaped = true;
  }
  if (!within(request.goal)) return NoWay::kGoalOutside;
  ends.goal = {map_.column(request.goal.x()), map_.row(request.goal.y())};
  if (!map_.contains(ends.goal.x, ends.goal.y)) return NoWay::kGoalOutside;
  return judgeGoal(request, ends.goal);
}

/// Marks the place nearest to the goal that can be reached: in rings round it.
void Planner::fail(NoWay why, const PlanRequest& request, const Ends& ends, Plan& plan) {
  plan.why = why;
  if (!ends.has_start) return;
  const Vector2d low(map_.centreX(0), map_.centreY(0));
  const Vector2d high(map_.centreX(map_.size_x - 1), map_.centreY(map_.size_y - 1));
  const Vector2d goal = request.goal.cwiseMax(low).cwiseMin(high);
  const Cell middle{map_.column(goal.x()), map_.row(goal.y())};
  search_.find(field_, ends.start, middle);
  plan.expanded += search_.expanded();
  double least = HUGE_VAL;
  const auto look = [&](int x, int y) {
    if (!map_.contains(x, y) || !search_.reached(field_, {x, y})) return;
    const Vector2d place(map_.centreX(x), map_.centreY(y));
    const double off = (place - request.goal).norm();
    if (off >= least) return;
    least = off;
    plan.nearest = place;
  };
  const int farthest = std::max(map_.size_x, map_.size_y);
  // What lies in a ring is at least as far from the goal's cell; the cut to the map adds the same
  // to all.
  const double spare = (goal - request.goal).norm() + map_.cell_size;
  for (int ring = 0; ring <= farthest && ring * map_.cell_size <= least + spare; ++ring) {
    for (int i = -ring; i <= ring; ++i) {
      look(middle.x + i, middle.y - ring);
      look(middle.x + i, middle.y + ring);
      look(middle.x - ring, middle.y + i);
      look(middle.x + ring, middle.y + i);
    }
  }
}

/// The search's way, pulled straight, as points of the map's frame.
void Planner::lay(const PlanRequest& request, const Ends& ends, Plan& plan) {
  search_.trace(field_, cells_);
  smoother_.smooth(field_, cells_, grid_points_);
  points_.clear();
  points_.push_back(request.start.position());
  plan.cost = 0.0;
  for (std::size_t i = 0; i < grid_points_.size(); ++i) {
    const bool end = i == 0 || i + 1 == grid_points_.size();
    if (i > 0) {
      plan.cost +=
          map_.cell_size * straightCost(field_, grid_points_[i - 1], grid_points_[i], HUGE_VAL);
    }
    if (end && !(i == 0 && ends.escaped)) continue;
    points_.push_back(Vector2d(map_.origin_x, map_.origin_y) + map_.cell_size * grid_points_[i]);
  }
  points_.push_back(request.goal);
}

/// The first pose on the rounded way at which the outline would touch. What touches where it starts
/// is not the way's fault.
std::optional<Pose2> Planner::firstTouch(const FootprintCheck& check, const PlanRequest& request,
                                         const Route& route) const {
  bool was_free = false;
  const auto touches = [&](const Pose2& pose) {
    const bool free = check.fits(field_, map_, pose);
    was_free = was_free || free;
    return was_free && !free;
  };
  double heading = request.start.heading;
  std::optional<Pose2> touch;
  const auto look = [&](const Pose2& pose) {
    if (!touches(pose)) return false;
    touch = pose;
    return true;
  };
  const double step = 0.5 * map_.cell_size;
  const int steps = static_cast<int>(std::ceil(route.length() / step));
  for (int i = 0; i <= steps; ++i) {
    const Route::Place place = route.at(std::min(route.length(), i * step));
    const double next = turns() ? angleOf(place.direction) : request.start.heading;
    const bool corner = i > 0 && std::abs(wrapped(next - heading)) > kHeadingStep;
    if (corner && turning(place.position, heading, next, look)) return touch;
    heading = next;
    if (look({place.position.x(), place.position.y(), heading})) return touch;
  }
  if (request.heading) turning(request.goal, heading, *request.heading, look);
  return touch;
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
    const auto touch = firstTouch(check_, request, route);
    if (!touch || i == kTightenings || !tighten(touch->position())) return touch;
  }
}

/// Keeps the search off a place where the outline would touch.
void Planner::close(const Pose2& touch, int attempt, const Ends& ends) {
  const int reach = 1 + attempt / 3;
  const Cell middle{map_.column(touch.x), map_.row(touch.y)};
  for (int y = middle.y - reach; y <= middle.y + reach; ++y) {
    for (int x = middle.x - reach; x <= middle.x + reach; ++x) {
      const Cell cell{x, y};
      if (!map_.contains(x, y) || cell == ends.start || cell == ends.goal) continue;
      field_.close(x, y);
      closed_.include(x, y);
    }
  }
}

void Planner::reopen() {
  if (!closed_.empty()) field_.update(map_, closed_);
  closed_ = {};
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

Plan Planner::plan(const PlanRequest& request) {
  Plan plan;
  Ends ends;
  const NoWay fault = findEnds(request, ends);
  if (fault != NoWay::kNone) {
    fail(fault, request, ends, plan);
    return plan;
  }
  std::optional<Pose2> touch;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const bool found = search_.find(field_, ends.start, ends.goal).has_value();
    plan.expanded += search_.expanded();
    if (!found) break;
    lay(request, ends, plan);
    touch = touchOf(request, plan);
    if (!touch) {
      reopen();
      putPoses(request, plan);
      return plan;
    }
    close(*touch, attempt, ends);
  }
  const bool at_goal = touch && (touch->position() - request.goal).norm() < check_.circumscribed();
  fail(at_goal ? NoWay::kGoalTight : NoWay::kTooNarrow, request, ends, plan);
  reopen();
  if (!touch) plan.why = whatParts(map_, field_, ends.start, ends.goal);
  plan.length = plan.cost = 0.0;
  return plan;
}

bool Planner::free(const std::vector<Pose2>& poses) const {
  if (poses.empty() || !hasMap()) return true;
  std::vector<Vector2d> points;
  for (const Pose2& pose : poses) points.push_back(pose.position());
  PlanRequest request;
  request.start = poses.front();
  request.goal = points.back();
  return !firstTouch(bare_, request, Route(points, parameters_.corners));
}

}  // namespace pilothouse
