#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pilothouse {

enum class CellClass : std::uint8_t {
  kUnknown = 0,    ///< no or too few points
  kFloor = 1,      ///< drivable
  kThreshold = 2,  ///< drivable, slowly
  kObstacle = 3,
  kDropOff = 4,  ///< edge of a step down and what lies beyond
};

inline bool isDrivable(CellClass c) {
  return c == CellClass::kFloor || c == CellClass::kThreshold;
}

/// Where the cells lie in the base frame (x forward, y left, z up, origin on the floor) [m].
/// Cell (ix, iy) covers x_min + ix * cell_size and y_min + iy * cell_size onward and has the index
/// iy * size_x + ix: a row (fixed iy) is a lane that leads forward from the robot.
struct GridGeometry {
  float x_min = 0.0F;
  float y_min = 0.0F;
  float cell_size = 0.05F;
  int size_x = 0;
  int size_y = 0;

  std::size_t cells() const {
    return static_cast<std::size_t>(size_x) * static_cast<std::size_t>(size_y);
  }
  std::size_t index(int ix, int iy) const {
    return static_cast<std::size_t>(iy) * static_cast<std::size_t>(size_x) +
           static_cast<std::size_t>(ix);
  }
  bool contains(int ix, int iy) const { return ix >= 0 && iy >= 0 && ix < size_x && iy < size_y; }
  float centreX(int ix) const { return x_min + (static_cast<float>(ix) + 0.5F) * cell_size; }
  float centreY(int iy) const { return y_min + (static_cast<float>(iy) + 0.5F) * cell_size; }
};

/// The judged floor. Every vector has geometry.cells() entries.
struct FloorCells {
  GridGeometry geometry;
  std::vector<CellClass> classes;
  std::vector<float> heights;         ///< mean height in the base frame [m]; NaN where unknown
  std::vector<float> deviations;      ///< standard deviation of the heights [m]; NaN where unknown
  std::vector<std::uint32_t> counts;  ///< points in the cell
};

}  // namespace pilothouse
