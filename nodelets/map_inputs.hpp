#pragma once

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/LaserScan.h>

#include <Eigen/Geometry>

#include "core/cloud/checked.hpp"
#include "core/mapping/camera_sight.hpp"
#include "core/mapping/planar_scan.hpp"

namespace pilothouse {

/// What a camera could see, by its own word. @param nearest that it measures [m].
Checked<CameraSight> sightOf(const sensor_msgs::CameraInfo& info,
                             const Eigen::Isometry3d& T_base_optical, double nearest);

/// A scan in the plane; borrows the message's ranges. Refused where the scanner is not level.
Checked<PlanarScan> planarScanOf(const sensor_msgs::LaserScan& message,
                                 const Eigen::Isometry3d& T_base_scanner);

}  // namespace pilothouse
