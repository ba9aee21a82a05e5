#pragma once

#include <limits>
#include <random>

#include "core/floor/floor_cells.hpp"

namespace pilothouse {

/// A grid of any geometry and any classes: cells of 1 to 50 cm, ahead of or all round the robot.
inline FloorCells randomGrid(std::mt19937& random) {
  const auto uniform = [&random](float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(random);
  };
  FloorCells grid;
  GridGeometry& g = grid.geometry;
  g.cell_size = uniform(0.01F, 0.5F);
  g.size_x = std::uniform_int_distribution<int>(1, 30)(random);
  g.size_y = std::uniform_int_distribution<int>(1, 30)(random);
  g.x_min = uniform(0.0F, 1.0F) < 0.5F ? uniform(0.0F, 1.0F) : uniform(-4.0F, 0.0F);
  g.y_min = -uniform(-0.2F, 1.2F) * static_cast<float>(g.size_y) * g.cell_size;
  const double busy = uniform(0.0F, 1.0F);  // from nothing known to crowded
  std::discrete_distribution<int> kind({1.0, 1.0, 0.1, busy * 0.3, busy * 0.1});
  for (std::size_t i = 0; i < g.cells(); ++i) {
    const auto drawn = static_cast<CellClass>(kind(random));
    const bool known = drawn != CellClass::kUnknown;
    grid.classes.push_back(drawn);
    grid.heights.push_back(known ? uniform(-0.1F, 0.3F) : std::numeric_limits<float>::quiet_NaN());
    grid.deviations.push_back(known ? uniform(0.0F, 0.1F)
                                    : std::numeric_limits<float>::quiet_NaN());
    grid.counts.push_back(known ? 5U : 0U);
  }
  return grid;
}

}  // namespace pilothouse
