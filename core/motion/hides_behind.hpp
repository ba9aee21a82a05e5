#pragma once

#include <algorithm>
#include <cmath>

#include "core/motion/local_memory.hpp"

namespace pilothouse {

/// Whether the place right behind (x, y), as seen from the base's origin, was not seen.
inline bool hidesBehind(const FloorFrame& frame, double x, double y) {
  const GridGeometry& g = frame.geometry;
  const double size = static_cast<double>(g.cell_size), distance = std::hypot(x, y);
  for (const double farther : {1.5 * size, 3.0 * size}) {
    const double scale = 1.0 + farther / std::max(size, distance);
    const int ix = static_cast<int>(std::floor((scale * x - static_cast<double>(g.x_min)) / size));
    const int iy = static_cast<int>(std::floor((scale * y - static_cast<double>(g.y_min)) / size));
    if (g.contains(ix, iy) && frame.classes[g.index(ix, iy)] == CellClass::kUnknown) return true;
  }
  return false;
}

}  // namespace pilothouse
