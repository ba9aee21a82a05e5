#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/motion/local_memory.hpp"

namespace pilothouse {

/// What the frame says of the place that lies `farther` [m] from the base's origin than (x, y);
/// none outside the frame.
inline std::optional<CellClass> behind(const FloorFrame& frame, double x, double y,
                                       double farther) {
  const GridGeometry& g = frame.geometry;
  const double size = static_cast<double>(g.cell_size), distance = std::hypot(x, y);
  const double scale = 1.0 + farther / std::max(size, distance);
  const int ix = static_cast<int>(std::floor((scale * x - static_cast<double>(g.x_min)) / size));
  const int iy = static_cast<int>(std::floor((scale * y - static_cast<double>(g.y_min)) / size));
  if (!g.contains(ix, iy)) return std::nullopt;
  return frame.classes[g.index(ix, iy)];
}

/// Whether what looks like floor at (x, y) may be the foot of a thing: the place right behind it,
/// as seen from the base's origin, was not seen; or it lies at the near rim of the view, where the
/// camera sees no higher, and there is a thing behind it.
inline bool mayBeFoot(const FloorFrame& frame, double x, double y) {
  const double size = static_cast<double>(frame.geometry.cell_size);
  const auto before = behind(frame, x, y, -1.5 * size);
  const bool rim = !before || *before == CellClass::kUnknown;
  for (const double farther : {1.5 * size, 3.0 * size}) {
    const auto kind = behind(frame, x, y, farther);
    if (kind && (*kind == CellClass::kUnknown || (rim && !isDrivable(*kind)))) return true;
  }
  return false;
}

}  // namespace pilothouse
