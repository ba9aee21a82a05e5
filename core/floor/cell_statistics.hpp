#pragma once

#include <vector>

#include "core/floor/cell_moments.hpp"
#include "core/floor/floor_cells.hpp"

namespace pilothouse {

/// Fills counts, heights and deviations of `grid` from the sums of its cells. Cells with fewer than
/// `min_points` points become unknown with NaN height and deviation; the others are left floor.
void fillStatistics(const std::vector<CellMoments>& moments, const HeightScale& scale,
                    int min_points, FloorCells& grid);

}  // namespace pilothouse
