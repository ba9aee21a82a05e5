#pragma once

#include <cstdint>
#include <vector>

#include "core/cloud/cloud_view.hpp"
#include "core/cloud/depth_view.hpp"
#include "core/floor/floor_cells.hpp"

namespace pilothouse {

/// Which points of a split picture belong together.
enum class PointKind {
  kFloor,     ///< drivable: floor and threshold
  kObstacle,  ///< not drivable: obstacle and drop-off
};

/// Collects the points of one kind, in the picture's own frame (not the base), as packed little
/// endian float32 x y z [m], 12 bytes a point: the data of an unorganised PointCloud2.
/// @param classes one a point, as splitPoints() gives them for the same view.
/// @param out replaced; keeps its memory.
void gatherPoints(const CloudView& cloud, const std::vector<CellClass>& classes, PointKind kind,
                  std::vector<std::uint8_t>& out);
void gatherPoints(const DepthView& depth, const std::vector<CellClass>& classes, PointKind kind,
                  std::vector<std::uint8_t>& out);

}  // namespace pilothouse
