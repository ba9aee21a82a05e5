#include "core/planning/hidden_sides.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace pilothouse {
namespace {

using Eigen::Vector2d;

constexpr double kCell = 0.05;      // [m]
constexpr double kTrusted = 1.5;    // faces are judged from no farther [m]: beyond the camera errs
constexpr double kSeesFrom = 0.9;   // floor is seen from so far off ...
constexpr double kSeesTo = 2.5;     // ... to so far [m] ...
constexpr double kSeesAside = 0.4;  // ... and so far to either side [rad]
constexpr double kBesideRobot = 0.1;  // nearer to the robot than this nothing stands unnoticed [m]
constexpr double kPart = 0.02;        // of the angle, for what stands before what [rad]
constexpr int kParts = 41;            // of the view

std::int32_t cellOf(double metres) {
  return static_cast<std::int32_t>(std::floor(metres / kCell));
}
std::pair<std::int32_t, std::int32_t> cellAt(const Vector2d& place) {
  return {cellOf(place.x()), cellOf(place.y())};
}
Vector2d centreOf(const std::pair<std::int32_t, std::int32_t>& cell) {
  return {(cell.first + 0.5) * kCell, (cell.second + 0.5) * kCell};
}

bool isFace(const MapMark& mark) {
  // Finite, and so near that cells can be counted.
  const bool sound = std::abs(mark.place.x()) < 1e5 && std::abs(mark.place.y()) < 1e5;
  return mark.kind == MapCell::kOccupied && sound;
}

}  // namespace

/// How far the view is free, by direction.
struct HiddenSides::Sight {
  Pose2 pose;
  std::array<double, kParts> free;

  Sight(const Pose2& from, const std::vector<MapMark>& marks) : pose(from) {
    free.fill(kSeesTo);
    for (const MapMark& mark : marks) {
      if (!isFace(mark)) continue;
      const Vector2d p = pose.toBase(mark.place);
      const double off = p.norm(), half = std::atan2(mark.radius + kCell, off);
      const double bearing = std::atan2(p.y(), p.x());
      const int last = std::min(kParts - 1, partOf(bearing + half));
      for (int i = std::max(0, partOf(bearing - half)); i <= last; ++i) {
        free[static_cast<std::size_t>(i)] = std::min(free[static_cast<std::size_t>(i)], off);
      }
    }
  }
  static int partOf(double bearing) {
    return static_cast<int>(std::floor((bearing + 0.5 * kParts * kPart) / kPart));
  }
  bool sees(const Vector2d& place) const {
    const Vector2d p = pose.toBase(place);
    const double off = p.norm(), bearing = std::atan2(p.y(), p.x());
    const int part = partOf(bearing);
    if (off < kSeesFrom || std::abs(bearing) > kSeesAside || part < 0 || part >= kParts)
      return false;
    return off < free[static_cast<std::size_t>(part)];
  }
};

void HiddenSides::cast(const MapMark& mark, const Pose2& pose, const MarkedMap& map) {
  const Vector2d way = mark.place - pose.position();
  if (!(way.norm() > kCell) || way.norm() > kTrusted || map.knows(mark.place, mark.kind)) return;
  const Vector2d step = kCell * way.normalized();
  for (int i = 1; i * kCell <= kDepth; ++i) {
    const Vector2d place = mark.place + i * step;
    if (map.knows(place, mark.kind)) return;  // that is what hides the rest
    cells_.emplace(cellAt(place), cellAt(mark.place));
  }
}

std::vector<MapMark> HiddenSides::behind(std::vector<MapMark> marks, const Pose2& pose,
                                         const MarkedMap& map, double radius) {
  std::set<Cell> faces;
  for (const MapMark& mark : marks) {
    if (isFace(mark)) faces.insert(cellAt(mark.place));
  }
  const auto stands = [&](const Cell& face) {
    for (std::int32_t y = -1; y <= 1; ++y) {
      for (std::int32_t x = -1; x <= 1; ++x) {
        if (faces.count({face.first + x, face.second + y}) > 0) return true;
      }
    }
    return map.knows(centreOf(face), MapCell::kOccupied);  // learned meanwhile
  };
  for (const MapMark& mark : marks) {
    if (isFace(mark) && !mark.remembered) cast(mark, pose, map);
  }
  const Sight sight(pose, marks);
  for (auto cell = cells_.begin(); cell != cells_.end();) {
    const Vector2d place = centreOf(cell->first);
    const bool over = (place - pose.position()).norm() < radius + kBesideRobot;
    if (over || sight.sees(place) || !stands(cell->second)) {
      cell = cells_.erase(cell);
    } else {
      marks.push_back({place, 0.5 * kCell, MapCell::kOccupied, true, true});
      ++cell;
    }
  }
  return marks;
}

}  // namespace pilothouse
