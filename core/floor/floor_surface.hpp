#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "core/floor/floor_cells.hpp"

namespace pilothouse {

/// z = height + slope_x x + slope_y y in the base frame.
struct FloorSlope {
  double height = 0.0;   ///< at the origin [m]
  double slope_x = 0.0;  ///< [m/m]
  double slope_y = 0.0;
  double at(double x, double y) const { return height + slope_x * x + slope_y * y; }
};

/// The floor's height where it is not seen: planes fitted to known floor cells round the place.
/// Sums are kept per block of cells, so that each fit costs nine blocks, not hundreds of cells.
class FloorSurface {
 public:
  void configure(const GridGeometry& geometry);
  /// Fits anew. @param is_floor one entry a cell, non-zero where the cell belongs to the floor;
  /// @param heights one entry a cell [m], any value where it is no floor.
  void fit(const std::vector<std::uint8_t>& is_floor, const std::vector<float>& heights);
  /// Takes further floor cells in; they count from the next refit() on. @param cells `count`
  /// indices, none of them taken in before.
  void add(const std::uint32_t* cells, std::size_t count, const std::vector<float>& heights);
  void refit();
  /// Floor height expected at the centre of a cell [m]: from the blocks round it, where these hold
  /// floor; else from the whole floor's plane.
  float expected(int ix, int iy);
  /// The plane through all floor cells; level at height 0 before the first fit or without floor.
  const FloorSlope& whole() const { return whole_; }

 private:
  using Sums = Eigen::Matrix<double, 9, 1>;  // n, x, y, xx, xy, yy, h, xh, yh
  struct LocalPlane {
    float height = 0.0F, slope_x = 0.0F, slope_y = 0.0F;
    bool solved = false;
  };
  void sumColumns(int iy, const std::vector<std::uint8_t>& is_floor,
                  const std::vector<float>& heights);
  Sums sumOfBlock(int bx) const;
  static FloorSlope solve(const Sums& sums, const FloorSlope& prior);
  const LocalPlane& local(int bx, int by);

  GridGeometry geometry_;
  int blocks_x_ = 0, blocks_y_ = 0;
  std::array<std::vector<float>, 5> column_sums_;  // scratch of fit: of a block's columns
  std::vector<Sums> sums_;                         // a block
  std::vector<LocalPlane> planes_;                 // a block, solved when first asked for
  FloorSlope whole_;
};

}  // namespace pilothouse
