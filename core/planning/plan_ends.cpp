#include "core/planning/plan_ends.hpp"

#include <cmath>

namespace pilothouse {
namespace {

using Eigen::Vector2d;

constexpr double kFarthest = 1e6;  // cells farther off have no numbers [m]

bool within(const Vector2d& place) {
  return std::abs(place.x()) < kFarthest && std::abs(place.y()) < kFarthest;
}

/// From where it stands too near to something: the nearest cell that is free, straight.
std::optional<Cell> wayOut(const CostField& field, const MapCells& map, const Pose2& start,
                           double escape) {
  const Cell from{map.column(start.x), map.row(start.y)};
  const int reach = static_cast<int>(std::ceil(escape / map.cell_size));
  std::optional<Cell> best;
  double least = escape + map.cell_size;
  for (int y = from.y - reach; y <= from.y + reach; ++y) {
    for (int x = from.x - reach; x <= from.x + reach; ++x) {
      if (!map.contains(x, y) || field.weight(x, y) == 0) continue;
      const Vector2d way = Vector2d(map.centreX(x), map.centreY(y)) - start.position();
      if (way.norm() >= least) continue;
      bool open = true;
      const int steps = static_cast<int>(2.0 * way.norm() / map.cell_size) + 1;
      for (int i = 1; i < steps && open; ++i) {
        const Vector2d place = start.position() + way * i / steps;
        const Cell cell{map.column(place.x()), map.row(place.y())};
        // Its own cell may count as blocked: it stands there all the same.
        open = cell == from || !field.blocked(cell.x, cell.y);
      }
      if (!open) continue;
      best = Cell{x, y};
      least = way.norm();
    }
  }
  return best;
}

NoWay judgeGoal(const CostField& field, const MapCells& map, const FootprintCheck& check,
                const PlanRequest& request, const Cell& goal) {
  const MapCell kind = map.at(goal.x, goal.y);
  if (kind == MapCell::kOccupied) return NoWay::kGoalOccupied;
  if (kind == MapCell::kDropOff) return NoWay::kGoalDropOff;
  if (field.blocked(goal.x, goal.y)) return NoWay::kGoalUnknown;
  if (field.weight(goal.x, goal.y) == 0) return NoWay::kGoalTight;
  if (!request.heading) return NoWay::kNone;
  const Pose2 end{request.goal.x(), request.goal.y(), *request.heading};
  return check.fits(field, map, end) ? NoWay::kNone : NoWay::kGoalHeadingTight;
}

NoWay findStart(const CostField& field, const MapCells& map, const Pose2& start, double escape,
                PlanEnds& ends) {
  ends.start = {map.column(start.x), map.row(start.y)};
  if (!map.contains(ends.start.x, ends.start.y)) return NoWay::kStartOutside;
  ends.has_start = field.weight(ends.start.x, ends.start.y) != 0;
  if (ends.has_start) return NoWay::kNone;
  const auto out = wayOut(field, map, start, escape);
  if (!out) return NoWay::kStartBlocked;
  ends.start = *out;
  ends.has_start = ends.escaped = true;
  return NoWay::kNone;
}

}  // namespace

PlanEnds findEnds(const CostField& field, const MapCells& map, const FootprintCheck& check,
                  const PlanRequest& request, double escape) {
  PlanEnds ends;
  const auto refused = [&ends](NoWay why) {
    ends.why = why;
    return ends;
  };
  if (map.size_x <= 0) return refused(NoWay::kNoMap);
  const bool finite = request.start.finite() && request.goal.allFinite() &&
                      (!request.heading || std::isfinite(*request.heading));
  if (!finite || !within(request.start.position())) return refused(NoWay::kNotFinite);
  const NoWay fault = findStart(field, map, request.start, escape, ends);
  if (fault != NoWay::kNone) return refused(fault);
  if (!within(request.goal)) return refused(NoWay::kGoalOutside);
  ends.goal = {map.column(request.goal.x()), map.row(request.goal.y())};
  if (!map.contains(ends.goal.x, ends.goal.y)) return refused(NoWay::kGoalOutside);
  return refused(judgeGoal(field, map, check, request, ends.goal));
}

}  // namespace pilothouse
