#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pilothouse {

/// What a cell of the map is taken for by a planner.
enum class MapCell : std::uint8_t {
  kUnknown = 0,    ///< never seen
  kFree = 1,       ///< floor without anything on it
  kThreshold = 2,  ///< may be crossed, slowly
  kOccupied = 3,   ///< something stands there
  kDropOff = 4,    ///< step down: never to be crossed
};

/// A judged map of the floor, in the map frame (x, y in the floor's plane). Cell (ix, iy) covers
/// [origin_x + ix * cell_size, ... + cell_size) in x and the like in y, and has the index
/// iy * size_x + ix.
struct MapCells {
  double origin_x = 0.0, origin_y = 0.0;  ///< lower left corner of cell (0, 0) [m]
  double cell_size = 0.05;                ///< [m], > 0
  int size_x = 0, size_y = 0;
  std::vector<MapCell> cells;  ///< size_x * size_y

  bool contains(int ix, int iy) const { return ix >= 0 && iy >= 0 && ix < size_x && iy < size_y; }
  std::size_t index(int ix, int iy) const {
    return static_cast<std::size_t>(iy) * static_cast<std::size_t>(size_x) +
           static_cast<std::size_t>(ix);
  }
  MapCell at(int ix, int iy) const {
    return contains(ix, iy) ? cells[index(ix, iy)] : MapCell::kUnknown;
  }
  /// Column and row of a place [m]; may lie outside. The place must be finite and within 1e8 cells.
  int column(double x) const { return static_cast<int>(std::floor((x - origin_x) / cell_size)); }
  int row(double y) const { return static_cast<int>(std::floor((y - origin_y) / cell_size)); }
  double centreX(int ix) const { return origin_x + (ix + 0.5) * cell_size; }
  double centreY(int iy) const { return origin_y + (iy + 0.5) * cell_size; }
};

}  // namespace pilothouse
