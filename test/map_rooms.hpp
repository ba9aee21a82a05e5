#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "core/mapping/map_cells.hpp"

namespace pilothouse {

/// A box on the floor, its sides along the axes [m].
struct FloorBox {
  Eigen::Vector2d low, high;
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

}  // namespace pilothouse
