#include "doors/scan_views.hpp"

#include <cmath>
#include <string>

namespace pilothouse {
namespace {

constexpr std::size_t kMostBeams = 100'000;
constexpr double kMostTilt = 0.0524;        // [rad]
constexpr std::uint32_t kMostCells = 4096;  // a side
constexpr double kFarthest = 1e4;           // of a map's origin [m]
constexpr int kOccupiedFrom = 65, kFreeBelow = 25;

std::string text(double value) {
  return std::to_string(value);
}

}  // namespace

Checked<ScanBeams> openScan(const sensor_msgs::LaserScan& scan) {
  using Result = Checked<ScanBeams>;
  if (scan.ranges.empty() || scan.ranges.size() > kMostBeams) {
    return Result::refused("ranges has " + std::to_string(scan.ranges.size()) +
                           " beams, expected 1 to " + std::to_string(kMostBeams));
  }
  ScanBeams beams{scan.header.stamp.toSec(),
                  static_cast<double>(scan.angle_min),
                  static_cast<double>(scan.angle_increment),
                  static_cast<double>(scan.time_increment),
                  static_cast<double>(scan.range_min),
                  static_cast<double>(scan.range_max),
                  {}};
  const double count = static_cast<double>(scan.ranges.size());
  if (!(std::abs(beams.angle_min) <= 10.0) || !(std::abs(beams.angle_increment) * count <= 7.0)) {
    return Result::refused("angle_min and angle_increment are " + text(beams.angle_min) + " and " +
                           text(beams.angle_increment) +
                           ", expected within 10 rad and at most a turn in all");
  }
  if (!(beams.time_increment >= 0.0 && beams.time_increment * count <= 2.0)) {
    return Result::refused("time_increment is " + text(beams.time_increment) +
                           ", expected 0 or more and at most 2 s a scan");
  }
  if (!(beams.range_min >= 0.0 && beams.range_max > beams.range_min && beams.range_max <= 1e4)) {
    return Result::refused("range_min and range_max are " + text(beams.range_min) + " and " +
                           text(beams.range_max) +
                           ", expected 0 <= range_min < range_max <= 10000 m");
  }
  beams.ranges = scan.ranges;
  return Result::of(std::move(beams));
}

std::optional<ScanMounting> levelMounting(const Eigen::Isometry3d& T_base_sensor) {
  const Eigen::Matrix3d& turn = T_base_sensor.linear();
  if (!T_base_sensor.matrix().allFinite() || std::abs(turn(2, 2)) < std::cos(kMostTilt)) {
    return std::nullopt;
  }
  return ScanMounting{{T_base_sensor.translation().x(), T_base_sensor.translation().y(),
                       std::atan2(turn(1, 0), turn(0, 0))},
                      turn(2, 2) < 0.0};
}

Checked<PoseEstimate> openPose(const geometry_msgs::PoseWithCovarianceStamped& pose) {
  using Result = Checked<PoseEstimate>;
  const auto& place = pose.pose.pose.position;
  const auto& q = pose.pose.pose.orientation;
  if (!std::isfinite(place.x) || !std::isfinite(place.y)) {
    return Result::refused("position is " + text(place.x) + " " + text(place.y) +
                           ", expected finite numbers");
  }
  const double norm = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
  if (!(std::abs(norm - 1.0) < 1e-2)) {
    return Result::refused("orientation is " + text(q.x) + " " + text(q.y) + " " + text(q.z) + " " +
                           text(q.w) + ", expected a unit quaternion");
  }
  PoseEstimate estimate;
  estimate.stamp = pose.header.stamp.toSec();
  estimate.pose = {place.x, place.y,
                   std::atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z))};
  constexpr int kPlanar[3] = {0, 1, 5};  // x, y and turn about z, of six
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      estimate.covariance(row, column) =
          pose.pose.covariance[static_cast<std::size_t>(6 * kPlanar[row] + kPlanar[column])];
    }
  }
  return Result::of(estimate);
}

Checked<MapCells> openMap(const nav_msgs::OccupancyGrid& map) {
  using Result = Checked<MapCells>;
  const auto& info = map.info;
  if (info.width == 0 || info.height == 0 || info.width > kMostCells || info.height > kMostCells) {
    return Result::refused("map is " + std::to_string(info.width) + " x " +
                           std::to_string(info.height) + " cells, expected 1 to " +
                           std::to_string(kMostCells) + " a side");
  }
  if (map.data.size() != std::size_t{info.width} * info.height) {
    return Result::refused("data has " + std::to_string(map.data.size()) + " cells, expected " +
                           std::to_string(std::size_t{info.width} * info.height));
  }
  if (!(info.resolution >= 0.005F && info.resolution <= 1.0F)) {
    return Result::refused("resolution is " + text(static_cast<double>(info.resolution)) +
                           ", expected 0.005 to 1 m");
  }
  const auto& origin = info.origin;
  if (!(std::abs(origin.position.x) <= kFarthest && std::abs(origin.position.y) <= kFarthest) ||
      !(std::abs(origin.orientation.x) < 1e-6 && std::abs(origin.orientation.y) < 1e-6 &&
        std::abs(origin.orientation.z) < 1e-6)) {
    return Result::refused("origin is far away or turned, expected within 10 km and no rotation");
  }
  MapCells cells{origin.position.x,
                 origin.position.y,
                 static_cast<double>(info.resolution),
                 static_cast<int>(info.width),
                 static_cast<int>(info.height),
                 {}};
  cells.cells.reserve(map.data.size());
  for (const std::int8_t value : map.data) {
    cells.cells.push_back(value >= kOccupiedFrom             ? MapCell::kOccupied
                          : value >= 0 && value < kFreeBelow ? MapCell::kFree
                                                             : MapCell::kUnknown);
  }
  return Result::of(std::move(cells));
}

}  // namespace pilothouse
