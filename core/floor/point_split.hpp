#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "core/cloud/cloud_view.hpp"
#include "core/cloud/depth_view.hpp"
#include "core/floor/floor_cells.hpp"
#include "core/floor/floor_parameters.hpp"

namespace pilothouse {

/// Gives each point of a picture a class by its cell and its height above the floor round it, which
/// is finer than the cell's class alone: the floor at the foot of a box stays floor, the foot of
/// the box does not become floor.
/// @param out one class a point, row by row; unknown where the point is invalid or off the grid.
void splitPoints(const CloudView& cloud, const Eigen::Isometry3f& T_base_camera,
                 const FloorCells& grid, const FloorParameters& parameters,
                 std::vector<CellClass>& out);
void splitPoints(const DepthView& depth, const Eigen::Isometry3f& T_base_optical,
                 const FloorCells& grid, const FloorParameters& parameters,
                 std::vector<CellClass>& out);

}  // namespace pilothouse
