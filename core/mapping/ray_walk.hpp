#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

namespace pilothouse {

/// Calls visit(ix, iy) for every cell that the straight line from (x0, y0) to (x1, y1) passes, in
/// its order, the last one included. In units of cells: cell (ix, iy) covers [ix, ix + 1) and the
/// like in y. After Amanatides and Woo, A Fast Voxel Traversal Algorithm for Ray Tracing,
/// Eurographics 1987. Ends must be finite and within +-1e8.
template <class Visit>
inline void walkRay(double x0, double y0, double x1, double y1, Visit visit) {
  auto ix = static_cast<std::int32_t>(std::floor(x0));
  auto iy = static_cast<std::int32_t>(std::floor(y0));
  const auto end_x = static_cast<std::int32_t>(std::floor(x1));
  const auto end_y = static_cast<std::int32_t>(std::floor(y1));
  const double dx = x1 - x0, dy = y1 - y0;
  const std::int32_t step_x = dx < 0.0 ? -1 : 1, step_y = dy < 0.0 ? -1 : 1;
  // Shares of the way at which the next border in x, in y is met; and from border to border.
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const double across_x = dx != 0.0 ? 1.0 / std::abs(dx) : kNever;
  const double across_y = dy != 0.0 ? 1.0 / std::abs(dy) : kNever;
  double next_x = dx != 0.0 ? (step_x > 0 ? ix + 1.0 - x0 : x0 - ix) * across_x : kNever;
  double next_y = dy != 0.0 ? (step_y > 0 ? iy + 1.0 - y0 : y0 - iy) * across_y : kNever;
  // Counted, not compared with the end: rounding can make the line miss its last cell by one.
  const std::int32_t steps = std::abs(end_x - ix) + std::abs(end_y - iy);
  visit(ix, iy);
  for (std::int32_t i = 0; i < steps; ++i) {
    if (next_x < next_y) {
      ix += step_x;
      next_x += across_x;
    } else {
      iy += step_y;
      next_y += across_y;
    }
    visit(ix, iy);
  }
}

}  // namespace pilothouse
