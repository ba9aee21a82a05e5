#pragma once

#include <pilothouse/ObjectList.h>
#include <sensor_msgs/LaserScan.h>
#include <std_msgs/Header.h>

#include <vector>

#include "core/floor/floor_grid.hpp"
#include "core/floor/floor_parameters.hpp"
#include "core/floor/nearest_objects.hpp"
#include "core/floor/virtual_scan.hpp"
#include "nodelets/floor_grid_message.hpp"

namespace pilothouse {

// Each call makes a fresh message: what was published is never changed.
// Every header's frame is the robot's base, its stamp the camera's.

FloorGridMessage::Ptr toMessage(const std_msgs::Header& header, const FloorGrid& grid,
                                FloorMethod method);
ObjectList::Ptr toMessage(const std_msgs::Header& header, const FloorGrid& grid,
                          const std::vector<GridObject>& objects);
sensor_msgs::LaserScan::Ptr toMessage(const std_msgs::Header& header, const ScanGeometry& scan,
                                      const std::vector<float>& ranges);

}  // namespace pilothouse
