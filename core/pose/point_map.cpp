#include "core/pose/point_map.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

namespace pilothouse {
namespace {

constexpr std::size_t kFewest = 5;   // points for a line
constexpr double kEnd = 0.25;        // of the radius: a line that goes on no farther ends there
constexpr double kNarrow = 0.1;      // of a line: variance across / along
constexpr double kEdgeRadius = 3.2;  // of a given map, in its cells
constexpr std::size_t kDirections = 240;
constexpr double kNear = 0.4;  // nearer a sensor may look over something [m]

std::size_t directionOf(const Eigen::Vector2d& ray) {
  constexpr double kTurn = 6.283185307179586;
  const double share = std::atan2(ray.y(), ray.x()) / kTurn + 0.5;
  return std::min(kDirections - 1, static_cast<std::size_t>(share * double{kDirections}));
}

}  // namespace

void PointMap::meet(const Eigen::Vector2d& place) {
  const auto [found, is_new] = squares_.try_emplace(keyOf(column(place.x()), column(place.y())),
                                                    Square{place, 1, 1, scans_, scans_ == 1});
  Square& square = found->second;
  if (is_new || square.sightings >= parameters_.most_sightings) return;
  if (square.scan != scans_) ++square.sightings;
  square.scan = scans_;
  square.mean += (place - square.mean) / static_cast<double>(++square.points);
}

void PointMap::add(const std::vector<Eigen::Vector2d>& points, const Pose2& pose,
                   const Eigen::Vector2d& from) {
  ++scans_;
  seeThrough(points, pose, from);
  for (const Eigen::Vector2d& point : points) meet(pose * point);
  if (squares_.size() > parameters_.most) forgetFar(pose.position());
}

void PointMap::seeThrough(const std::vector<Eigen::Vector2d>& points, const Pose2& pose,
                          const Eigen::Vector2d& from) {
  // The nearest that was met in each direction and its neighbours; 0: nothing, which tells nothing.
  std::array<double, kDirections> nearest{};
  double farthest = 0.0;
  for (const Eigen::Vector2d& point : points) {
    const Eigen::Vector2d ray = point - from;
    double& known = nearest[directionOf(ray)];
    if (known == 0.0 || ray.norm() < known) known = ray.norm();
    farthest = std::max(farthest, ray.norm());
  }
  for (auto entry = squares_.begin(); entry != squares_.end();) {
    Square& square = entry->second;
    const Eigen::Vector2d ray = pose.toBase(square.mean) - from;
    const double reach = ray.norm() + parameters_.behind;
    bool through = reach <= farthest && ray.norm() >= kNear;
    const std::size_t direction = through ? directionOf(ray) : 0;
    for (std::size_t i = kDirections - 1; through && i <= kDirections + 1; ++i) {
      through = nearest[(direction + i) % kDirections] > reach;
    }
    entry = through && --square.sightings <= 0 ? squares_.erase(entry) : std::next(entry);
  }
}

void PointMap::forgetFar(const Eigen::Vector2d& from) {
  std::vector<double> distances;
  distances.reserve(squares_.size());
  for (const auto& entry : squares_) distances.push_back((entry.second.mean - from).squaredNorm());
  // A tenth fewer than allowed, so that this is not needed for every scan.
  const auto limit = distances.begin() + static_cast<std::ptrdiff_t>(parameters_.most / 10 * 9);
  std::nth_element(distances.begin(), limit, distances.end());
  for (auto entry = squares_.begin(); entry != squares_.end();) {
    const bool far = (entry->second.mean - from).squaredNorm() >= *limit;
    entry = far ? squares_.erase(entry) : std::next(entry);
  }
}

std::optional<MapPoint> PointMap::pointAt(const Eigen::Vector2d& place, double radius) const {
  const int reach = static_cast<int>(std::ceil(radius / parameters_.cell));
  const std::int32_t middle_x = column(place.x()), middle_y = column(place.y());
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
  std::vector<Eigen::Vector2d> offsets;
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) {
      const auto found = squares_.find(keyOf(middle_x + x, middle_y + y));
      if (found == squares_.end() || !counts(found->second)) continue;
      const Eigen::Vector2d offset = found->second.mean - place;
      if (offset.norm() > radius) continue;
      sum += offset;
      squares += offset * offset.transpose();
      offsets.push_back(offset);
    }
  }
  if (offsets.size() < kFewest) return std::nullopt;
  const double count = static_cast<double>(offsets.size());
  const Eigen::Vector2d mean = sum / count;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(squares / count -
                                                            mean * mean.transpose());
  if (axes.eigenvalues()(0) > kNarrow * axes.eigenvalues()(1)) {
    return MapPoint{place};
  }
  MapPoint point{place, axes.eigenvectors().col(0)};
  const Eigen::Vector2d along = axes.eigenvectors().col(1);
  double back = 0.0, on = 0.0;
  for (const Eigen::Vector2d& offset : offsets) {
    back = std::min(back, along.dot(offset));
    on = std::max(on, along.dot(offset));
  }
  if (on < kEnd * radius) point.beyond = along;
  if (-back < kEnd * radius) point.beyond = -along;
  return point;
}

std::vector<MapPoint> PointMap::points() const {
  std::vector<MapPoint> points;
  points.reserve(squares_.size());
  for (const auto& entry : squares_) {
    if (!counts(entry.second)) continue;
    const Eigen::Vector2d& place = entry.second.mean;
    for (const double radius : {1.0, 2.0, 4.0}) {
      const auto point = pointAt(place, radius * parameters_.line_radius);
      if (!point) continue;
      points.push_back(*point);
      break;
    }
  }
  return points;
}

std::vector<MapPoint> edgesOf(const MapCells& map) {
  PointMapParameters parameters;
  parameters.cell = map.cell_size;
  parameters.line_radius = kEdgeRadius * map.cell_size;
  parameters.most = map.cells.size() + 1;
  std::vector<Eigen::Vector2d> edges;
  for (int y = 0; y < map.size_y; ++y) {
    for (int x = 0; x < map.size_x; ++x) {
      if (map.at(x, y) != MapCell::kOccupied) continue;
      const bool inside =
          map.at(x - 1, y) == MapCell::kOccupied && map.at(x + 1, y) == MapCell::kOccupied &&
          map.at(x, y - 1) == MapCell::kOccupied && map.at(x, y + 1) == MapCell::kOccupied;
      if (!inside) edges.emplace_back(map.centreX(x), map.centreY(y));
    }
  }
  PointMap points(parameters);
  points.add(edges, Pose2{});
  return points.points();
}

}  // namespace pilothouse
