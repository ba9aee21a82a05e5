#include "core/floor/floor_patches.hpp"

#include <cmath>

namespace pilothouse {

void FloorPatches::configure(const GridGeometry& geometry) {
  patches_.clear();
  patches_.reserve(geometry.cells());
  cells_.assign(geometry.cells(), 0);
  patch_of_.assign(geometry.cells(), -1);
}

void FloorPatches::find(const FloorCells& grid, const std::vector<std::uint8_t>& even,
                        float step_height) {
  constexpr std::int32_t kOpen = -2;
  const auto size_x = static_cast<std::uint32_t>(grid.geometry.size_x);
  const auto count = static_cast<std::uint32_t>(even.size());
  for (std::uint32_t i = 0; i < count; ++i) patch_of_[i] = even[i] != 0 ? kOpen : -1;
  patches_.clear();
  std::uint32_t end = 0;  // cells_[0, end) are labelled; the list is its own queue
  for (std::uint32_t start = 0; start < count; ++start) {
    if (patch_of_[start] != kOpen) continue;
    const auto number = static_cast<std::int32_t>(patches_.size());
    FloorPatch patch;
    patch.first = end;
    patch_of_[start] = number;
    cells_[end++] = start;
    for (std::uint32_t next = patch.first; next < end; ++next) {
      const std::uint32_t cell = cells_[next];
      const float height = grid.heights[cell];
      patch.points += grid.counts[cell];
      const auto visit = [&](std::uint32_t neighbour) {
        if (patch_of_[neighbour] != kOpen) return;
        if (!(std::abs(grid.heights[neighbour] - height) <= step_height)) return;
        patch_of_[neighbour] = number;
        cells_[end++] = neighbour;
      };
      const std::uint32_t column = cell % size_x;
      if (column > 0) visit(cell - 1);
      if (column + 1 < size_x) visit(cell + 1);
      if (cell >= size_x) visit(cell - size_x);
      if (cell + size_x < count) visit(cell + size_x);
    }
    patch.size = end - patch.first;
    patches_.push_back(patch);
  }
}

}  // namespace pilothouse
