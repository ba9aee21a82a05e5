#pragma once

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <nav_msgs/OccupancyGrid.h>
#include <sensor_msgs/LaserScan.h>

#include <Eigen/Geometry>
#include <optional>

#include "core/cloud/checked.hpp"
#include "core/mapping/map_cells.hpp"
#include "core/pose/pose_tracker.hpp"
#include "core/pose/scan_points.hpp"

namespace pilothouse {

// What the pose tracker takes in, checked. A refusal names the thing, its value and what was
// expected.

/// At most 100,000 beams, finite angles and times. The stamp is taken as the first beam's.
Checked<ScanBeams> openScan(const sensor_msgs::LaserScan& scan);

/// A scanner's mounting in the plane; nothing where it is tilted by more than 3 degrees.
std::optional<ScanMounting> levelMounting(const Eigen::Isometry3d& T_base_sensor);

/// A pose set by hand: finite, a unit quaternion; its covariance is the tracker's to judge.
Checked<PoseEstimate> openPose(const geometry_msgs::PoseWithCovarianceStamped& pose);

/// A map as map_server and others publish it: at most 4,096 cells a side, not turned. 65 and more
/// is occupied, 0..24 free, all else unknown.
Checked<MapCells> openMap(const nav_msgs::OccupancyGrid& map);

}  // namespace pilothouse
