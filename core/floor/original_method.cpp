#include "core/floor/original_method.hpp"

namespace pilothouse {

void judgeOriginal(const FloorParameters& parameters, FloorCells& grid) {
  const auto limit = static_cast<float>(parameters.obstacle_deviation);
  for (std::size_t i = 0; i < grid.classes.size(); ++i) {
    if (grid.classes[i] == CellClass::kUnknown) continue;
    grid.classes[i] = grid.deviations[i] > limit ? CellClass::kObstacle : CellClass::kFloor;
  }
}

}  // namespace pilothouse
