#pragma once

#include <vector>

#include "core/floor/floor_cells.hpp"

namespace pilothouse {

/// One cell that is not plain floor.
struct GridObject {
  int ix = 0, iy = 0;
  CellClass kind = CellClass::kObstacle;  ///< kThreshold, kObstacle or kDropOff
  bool nearest_in_row = false;  ///< first obstacle or drop-off met walking forward in its row
};

/// Lists what stands on (or is missing from) the floor, and which of it the robot would meet first
/// in each lane (KTU 2014, step 5: the first obstacle cell of a row gives the row's object).
/// Walking starts at the robot's origin, x = 0: what lies behind is listed but is never nearest.
/// Keeps its memory: no allocation once the largest grid was seen.
class NearestObjects {
 public:
  /// @return every threshold, obstacle and drop-off cell, row by row (iy) and forward (ix) in each
  /// row; valid until the next call.
  const std::vector<GridObject>& find(const FloorCells& grid);

 private:
  std::vector<GridObject> objects_;
};

}  // namespace pilothouse
