#include "core/pose/scan_points.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/pose/pose_algebra.hpp"

namespace pilothouse {

Pose2 TrackPiece::at(double stamp) const {
  const auto after =
      std::lower_bound(poses_.begin(), poses_.end(), stamp,
                       [](const auto& entry, double wanted) { return entry.first < wanted; });
  if (after == poses_.begin()) return poses_.front().second;
  if (after == poses_.end()) return poses_.back().second;
  const auto before = after - 1;
  return between(before->second, after->second,
                 (stamp - before->first) / (after->first - before->first));
}

std::vector<Eigen::Vector2d> pointsOf(const ScanBeams& scan, const ScanMounting& mounting,
                                      const TrackPiece& track, double reference) {
  std::vector<Eigen::Vector2d> points;
  points.reserve(scan.ranges.size());
  const Pose2 T_track_reference = track.at(reference);
  const double side = mounting.upside_down ? -1.0 : 1.0;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    const double range = scan.ranges[i];
    if (!(range >= scan.range_min && range <= scan.range_max && range > 0.0)) continue;
    const double beam = static_cast<double>(i);
    const double bearing = scan.angle_min + beam * scan.angle_increment;
    const Eigen::Vector2d in_base =
        mounting.T_base_sensor *
        Eigen::Vector2d(range * std::cos(bearing), side * range * std::sin(bearing));
    if (scan.time_increment == 0.0 && scan.stamp == reference) {
      points.push_back(in_base);
      continue;
    }
    const Pose2 then = track.at(scan.stamp + beam * scan.time_increment);
    points.push_back(T_track_reference.toBase(then * in_base));
  }
  return points;
}

std::vector<Eigen::Vector2d> thinned(const std::vector<Eigen::Vector2d>& points, double cell) {
  struct Filed {
    std::int64_t x, y;
    std::size_t point;
  };
  std::vector<Filed> filed;
  filed.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    filed.push_back({std::llround(std::floor(points[i].x() / cell)),
                     std::llround(std::floor(points[i].y() / cell)), i});
  }
  std::sort(filed.begin(), filed.end(), [](const Filed& a, const Filed& b) {
    if (a.x != b.x) return a.x < b.x;
    return a.y != b.y ? a.y < b.y : a.point < b.point;
  });
  std::vector<Eigen::Vector2d> thin;
  for (std::size_t i = 0; i < filed.size();) {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    const std::size_t first = i;
    while (i < filed.size() && filed[i].x == filed[first].x && filed[i].y == filed[first].y) {
      sum += points[filed[i++].point];
    }
    thin.push_back(sum / static_cast<double>(i - first));
  }
  return thin;
}

}  // namespace pilothouse
