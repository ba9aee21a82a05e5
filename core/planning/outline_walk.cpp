#include "core/planning/outline_walk.hpp"

#include <algorithm>
#include <cmath>

namespace pilothouse {
namespace {

using Eigen::Vector2d;

constexpr double kHeadingStep = 0.2;  // turning in place is looked at in such steps [rad]

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

std::optional<Pose2> firstTouch(const FootprintCheck& check, const CostField& field,
                                const MapCells& map, const Route& route, const OutlineWalk& walk) {
  bool was_free = false;
  std::optional<Pose2> touch;
  const auto look = [&](const Pose2& pose) {
    const bool free = check.fits(field, map, pose);
    was_free = was_free || free;
    if (!was_free || free) return false;
    touch = pose;
    return true;
  };
  double heading = walk.from;
  const double step = 0.5 * map.cell_size;
  const int steps = static_cast<int>(std::ceil(route.length() / step));
  for (int i = 0; i <= steps; ++i) {
    const Route::Place place = route.at(std::min(route.length(), i * step));
    const double next =
        walk.turns ? std::atan2(place.direction.y(), place.direction.x()) : walk.from;
    const bool corner = i > 0 && std::abs(wrapped(next - heading)) > kHeadingStep;
    if (corner && turning(place.position, heading, next, look)) return touch;
    heading = next;
    if (look({place.position.x(), place.position.y(), heading})) return touch;
  }
  if (walk.to) turning(route.at(route.length()).position, heading, *walk.to, look);
  return touch;
}

}  // namespace pilothouse
