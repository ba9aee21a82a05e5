#include "core/floor/nearest_objects.hpp"

#include <algorithm>
#include <cmath>

namespace pilothouse {

const std::vector<GridObject>& NearestObjects::find(const FloorCells& grid) {
  const GridGeometry& g = grid.geometry;
  objects_.clear();
  objects_.reserve(g.cells());
  // The first cell that reaches beyond x = 0.
  const int start = std::max(0, static_cast<int>(std::floor(-g.x_min / g.cell_size)));
  for (int iy = 0; iy < g.size_y; ++iy) {
    bool met = false;
    for (int ix = 0; ix < g.size_x; ++ix) {
      const CellClass kind = grid.classes[g.index(ix, iy)];
      if (kind == CellClass::kUnknown || kind == CellClass::kFloor) continue;
      const bool first = !met && ix >= start && !isDrivable(kind);
      met = met || first;
      objects_.push_back({ix, iy, kind, first});
    }
  }
  return objects_;
}

}  // namespace pilothouse
