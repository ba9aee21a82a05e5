#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <random>
#include <vector>

#include "core/mapping/map_cells.hpp"

namespace pilothouse {

/// A box on the floor, its sides along the axes [m].
struct FloorBox {
  Eigen::Vector2d low, high;

  double distanceTo(const Eigen::Vector2d& p) const {
    return (low - p).cwiseMax(p - high).cwiseMax(0.0).norm();
  }
};

/// Free floor with walls one cell thick round it and boxes on it.
struct MapRoom {
  MapCells map;
  std::vector<FloorBox> boxes;  ///< the walls are not among them
  double cell = 0.05;

  MapRoom(int size_x, int size_y) {
    map.size_x = size_x;
    map.size_y = size_y;
    map.cells.assign(static_cast<std::size_t>(size_x) * static_cast<std::size_t>(size_y),
                     MapCell::kFree);
    fill(0, 0, size_x, 1);
    fill(0, size_y - 1, size_x, size_y);
    fill(0, 0, 1, size_y);
    fill(size_x - 1, 0, size_x, size_y);
  }
  /// Columns [x0, x1), rows [y0, y1).
  void fill(int x0, int y0, int x1, int y1, MapCell kind = MapCell::kOccupied) {
    for (int y = std::max(0, y0); y < std::min(map.size_y, y1); ++y) {
      for (int x = std::max(0, x0); x < std::min(map.size_x, x1); ++x) {
        map.cells[map.index(x, y)] = kind;
      }
    }
  }
  void addBox(int x0, int y0, int x1, int y1) {
    fill(x0, y0, x1, y1);
    boxes.push_back({{cell * x0, cell * y0}, {cell * x1, cell * y1}});
  }
  /// Boxes of 0.1 to 1 m anywhere.
  void addBoxes(std::mt19937& random, int count) {
    const auto below = [&random](int n) {
      return static_cast<int>(random() % static_cast<unsigned>(n));
    };
    for (int i = 0; i < count; ++i) {
      const int x = below(map.size_x), y = below(map.size_y);
      addBox(x, y, std::min(map.size_x, x + 2 + below(18)),
             std::min(map.size_y, y + 2 + below(18)));
    }
  }
};

/// Length of the shortest way of a disc's middle among boxes, to within 0.2 % below: a visibility
/// graph over points on the arcs round the boxes' corners. Infinite where there is none.
inline double shortestAmong(const MapRoom& room, double radius, const Eigen::Vector2d& start,
                            const Eigen::Vector2d& goal) {
  constexpr int kSteps = 12;  // of a quarter turn
  const double near = radius * std::cos(0.25 * 3.14159265358979 / kSteps) - 1e-9;
  const auto clear = [&](const Eigen::Vector2d& p) {
    const Eigen::Vector2d low(room.cell + near, room.cell + near);
    const Eigen::Vector2d high(room.cell * (room.map.size_x - 1) - near,
                               room.cell * (room.map.size_y - 1) - near);
    if ((p.array() < low.array()).any() || (p.array() > high.array()).any()) return false;
    return std::all_of(room.boxes.begin(), room.boxes.end(),
                       [&](const FloorBox& box) { return box.distanceTo(p) >= near; });
  };
  const auto sees = [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    // Each box's distance along the segment is convex: its least by thirds.
    for (const FloorBox& box : room.boxes) {
      double from = 0.0, to = 1.0;
      for (int i = 0; i < 40; ++i) {
        const double p = from + (to - from) / 3.0, q = to - (to - from) / 3.0;
        (box.distanceTo(a + p * (b - a)) < box.distanceTo(a + q * (b - a)) ? to : from) =
            box.distanceTo(a + p * (b - a)) < box.distanceTo(a + q * (b - a)) ? q : p;
      }
      if (box.distanceTo(a + 0.5 * (from + to) * (b - a)) < near) return false;
    }
    return true;
  };
  std::vector<Eigen::Vector2d> points = {start, goal};
  for (const FloorBox& box : room.boxes) {
    for (int corner = 0; corner < 4; ++corner) {
      const Eigen::Vector2d at(corner == 0 || corner == 3 ? box.high.x() : box.low.x(),
                               corner < 2 ? box.high.y() : box.low.y());
      for (int i = 0; i <= kSteps; ++i) {
        const double angle = 0.5 * 3.14159265358979 * (corner + static_cast<double>(i) / kSteps);
        const Eigen::Vector2d point =
            at + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle));
        if (clear(point)) points.push_back(point);
      }
    }
  }
  std::vector<double> lengths(points.size(), std::numeric_limits<double>::infinity());
  std::vector<bool> done(points.size(), false);
  lengths[0] = 0.0;
  for (;;) {
    std::size_t best = points.size();
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < points.size(); ++i) {
      // A* by the straight distance.
      const double estimate = lengths[i] + (points[i] - goal).norm();
      if (!done[i] && estimate < least) {
        best = i;
        least = estimate;
      }
    }
    if (best == points.size() || best == 1) return lengths[1];
    done[best] = true;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double length = lengths[best] + (points[i] - points[best]).norm();
      if (!done[i] && length < lengths[i] && sees(points[best], points[i])) lengths[i] = length;
    }
  }
}

}  // namespace pilothouse
