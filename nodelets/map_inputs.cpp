#include "nodelets/map_inputs.hpp"

#include "doors/scan_views.hpp"

namespace pilothouse {

Checked<CameraSight> sightOf(const sensor_msgs::CameraInfo& info,
                             const Eigen::Isometry3d& T_base_optical, double nearest) {
  using Result = Checked<CameraSight>;
  const bool rectified = info.P[0] > 0.0;
  CameraSight sight;
  sight.T_base_optical = T_base_optical;
  sight.intrinsics = rectified ? Intrinsics{info.P[0], info.P[5], info.P[2], info.P[6]}
                               : Intrinsics{info.K[0], info.K[4], info.K[2], info.K[5]};
  sight.width = info.width;
  sight.height = info.height;
  sight.nearest = nearest;
  if (sight.intrinsics.fx >= 1.0 && sight.intrinsics.fy >= 1.0) return Result::of(sight);
  return Result::refused("focal lengths are " + std::to_string(sight.intrinsics.fx) + " and " +
                         std::to_string(sight.intrinsics.fy) + ", expected at least 1 pixel");
}

Checked<PlanarScan> planarScanOf(const sensor_msgs::LaserScan& message,
                                 const Eigen::Isometry3d& T_base_scanner) {
  using Result = Checked<PlanarScan>;
  const auto beams = openScan(message);
  if (!beams) return Result::refused(beams.reason());
  const auto level = levelMounting(T_base_scanner);
  if (!level) return Result::refused("the scanner is tilted, expected within 3 degrees");
  const double turn = level->upside_down ? -1.0 : 1.0;
  PlanarScan scan;
  scan.T_base_scan = level->T_base_sensor;
  scan.angle_min = turn * beams->angle_min;
  scan.increment = turn * beams->angle_increment;
  scan.range_min = beams->range_min;
  scan.range_max = beams->range_max;
  scan.ranges = message.ranges.data();
  scan.count = message.ranges.size();
  return Result::of(scan);
}

}  // namespace pilothouse
