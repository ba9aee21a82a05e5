#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/floor/floor_cells.hpp"
#include "core/floor/floor_surface.hpp"

namespace pilothouse {

/// The plane that the robot stands on, from the floor nearest to it.
class NearFloor {
 public:
  void configure(const GridGeometry& geometry);
  /// Robust fit that starts with the nearest floor and grows outward; what leaves the plane, such
  /// as the foot of a ramp, falls out. @param is_floor one entry a cell, non-zero for floor.
  /// @return nothing where too little floor is seen.
  std::optional<FloorSlope> fit(const std::vector<std::uint8_t>& is_floor, const FloorCells& grid);

 private:
  struct Range {
    Eigen::Index first, count;  ///< of the listed cells
  };
  Range range(float begin, float end) const;
  std::optional<FloorSlope> start();
  std::optional<FloorSlope> solve(Range range, const FloorSlope& from, float gate);
  auto residuals(Range range, const FloorSlope& plane) const {
    return height_.segment(range.first, range.count) - static_cast<float>(plane.height) -
           static_cast<float>(plane.slope_x) * x_.segment(range.first, range.count) -
           static_cast<float>(plane.slope_y) * y_.segment(range.first, range.count);
  }
  void gather(const std::vector<std::uint8_t>& is_floor, const FloorCells& grid);

  Eigen::Index count_ = 0;                  // cells listed at the head of:
  Eigen::ArrayXf x_, y_, height_, weight_;  // [m]; weight_ is scratch
};

}  // namespace pilothouse
