#pragma once

#include <pilothouse/MapGrid.h>
#include <pilothouse/ObjectList.h>

#include <vector>

#include "core/cloud/checked.hpp"
#include "core/mapping/map_cells.hpp"
#include "core/motion/obstacle.hpp"

namespace pilothouse {

/// A map that came as a message, checked: its cells are there, its place is finite and within
/// 10 km, and no class is unknown. A refusal names the thing, its value and what was expected.
Checked<MapCells> openMap(const MapGrid& grid);

/// Objects of a list, in its frame; source 0 is the camera, 1 any other. Refused where one is
/// nowhere, has no size, or is of no known kind.
Checked<std::vector<Obstacle>> openObjects(const ObjectList& list);

/// @param stamp, frame of the message's header.
MapGrid::Ptr toMessage(const MapCells& map, const std::string& frame, const ros::Time& stamp,
                       std::uint32_t version);

}  // namespace pilothouse
