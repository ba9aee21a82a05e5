#pragma once

#include <cstdint>
#include <vector>

#include "core/floor/floor_cells.hpp"

namespace pilothouse {

/// Connected even cells: neighbours (4) whose mean heights differ by at most a step.
struct FloorPatch {
  std::uint32_t first = 0;  ///< its cells are cells[first .. first + size)
  std::uint32_t size = 0;
  std::uint64_t points = 0;  ///< measured points in all its cells
};

/// Splits the even cells of a grid (known, deviation at most a limit) into patches. Keeps its
/// memory.
class FloorPatches {
 public:
  void configure(const GridGeometry& geometry);
  /// @param even one entry a cell, non-zero where the cell is even; @param step_height [m].
  void find(const FloorCells& grid, const std::vector<std::uint8_t>& even, float step_height);

  const std::vector<FloorPatch>& patches() const { return patches_; }
  const std::vector<std::uint32_t>& cells() const { return cells_; }
  /// Number of the cell's patch, or -1 where the cell is not even.
  const std::vector<std::int32_t>& patchOf() const { return patch_of_; }

 private:
  std::vector<FloorPatch> patches_;
  std::vector<std::uint32_t> cells_;
  std::vector<std::int32_t> patch_of_;
};

}  // namespace pilothouse
