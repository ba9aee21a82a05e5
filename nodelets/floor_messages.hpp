#pragma once

#include <pilothouse/ObjectList.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/PointCloud2.h>
#include <std_msgs/Header.h>

#include <vector>

#include <pilothouse/FloorGrid.h>
#include "core/floor/floor_cells.hpp"
#include "core/floor/floor_parameters.hpp"
#include "core/floor/nearest_objects.hpp"
#include "core/floor/virtual_scan.hpp"

namespace pilothouse {

// Each call makes a fresh message: what was published is never changed.
// The headers' stamp is the camera's; their frame the robot's base unless said otherwise.

FloorGrid::Ptr toMessage(const std_msgs::Header& header, const FloorCells& grid,
                         FloorMethod method);
ObjectList::Ptr toMessage(const std_msgs::Header& header, const FloorCells& grid,
                          const std::vector<GridObject>& objects);
sensor_msgs::LaserScan::Ptr toMessage(const std_msgs::Header& header, const ScanGeometry& scan,
                                      const std::vector<float>& ranges);
/// An unorganised cloud of x y z. @param camera the header of the picture: the points are in its
/// frame.
/// @param xyz packed float32, 12 bytes a point; taken over.
sensor_msgs::PointCloud2::Ptr toMessage(const std_msgs::Header& camera,
                                        std::vector<std::uint8_t>&& xyz);

}  // namespace pilothouse
