#pragma once

#include <nav_msgs/OccupancyGrid.h>

#include "core/mapping/map_cells.hpp"

namespace pilothouse {

/// -1 unknown, 0 free, 20 threshold (which others take for free), 100 occupied or drop-off.
nav_msgs::OccupancyGrid::Ptr toOccupancyGrid(const std_msgs::Header& header, const MapCells& map);

}  // namespace pilothouse
