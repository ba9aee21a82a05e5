#include "core/planning/footprint_check.hpp"

#include <algorithm>
#include <utility>

namespace pilothouse {

FootprintCheck::FootprintCheck(Footprint footprint, double spare)
    : footprint_(std::move(footprint)),
      spare_(spare),
      inscribed_(std::max(0.0, -footprint_.distanceTo({0.0, 0.0}))),
      circumscribed_(footprint_.farthestFrom({0.0, 0.0})) {}

bool FootprintCheck::fits(const CostField& field, const MapCells& map, const Pose2& pose) const {
  const int column = map.column(pose.x), row = map.row(pose.y);
  if (!map.contains(column, row)) return true;
  // The middle of the cell is nearer than this to the pose.
  const double off = 0.71 * map.cell_size;
  if (field.clearance(column, row) - off >= ample()) return true;
  const double keep = spare_ + 0.5 * map.cell_size;
  const int reach = static_cast<int>((circumscribed_ + keep) / map.cell_size) + 1;
  for (int y = std::max(0, row - reach); y <= std::min(map.size_y - 1, row + reach); ++y) {
    for (int x = std::max(0, column - reach); x <= std::min(map.size_x - 1, column + reach); ++x) {
      if (!field.blocked(x, y)) continue;
      const Eigen::Vector2d place = pose.toBase({map.centreX(x), map.centreY(y)});
      if (place.squaredNorm() > (circumscribed_ + keep) * (circumscribed_ + keep)) continue;
      if (footprint_.distanceTo(place) < keep) return false;
    }
  }
  return true;
}

}  // namespace pilothouse
