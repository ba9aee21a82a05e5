#include "core/floor/near_floor.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <limits>

namespace pilothouse {
namespace {

struct Round {
  float reach;  // floor used beyond the nearest cell [m]
  float gate;   // residuals beyond weigh nothing [m]
};
constexpr std::array<Round, 7> kRounds = {{{0.4F, 1e3F},
                                           {0.4F, 0.02F},
                                           {0.4F, 0.01F},
                                           {0.6F, 0.006F},
                                           {0.9F, 0.004F},
                                           {1.2F, 0.004F},
                                           {1.2F, 0.004F}}};
constexpr Eigen::Index kFewestCells = 60;

}  // namespace

void NearFloor::configure(const GridGeometry& geometry) {
  const auto cells = static_cast<Eigen::Index>(geometry.cells());
  x_.resize(cells);
  y_.resize(cells);
  height_.resize(cells);
  weight_.resize(cells);
}

/// Lists the floor cells within the last round's reach, nearest first.
void NearFloor::gather(const std::vector<std::uint8_t>& is_floor, const FloorGrid& grid) {
  const GridGeometry& g = grid.geometry;
  count_ = 0;
  float end = std::numeric_limits<float>::infinity();
  for (int ix = 0; ix < g.size_x && g.centreX(ix) <= end; ++ix) {
    for (int iy = 0; iy < g.size_y; ++iy) {
      const std::size_t i = g.index(ix, iy);
      if (is_floor[i] == 0) continue;
      if (count_ == 0) end = g.centreX(ix) + kRounds.back().reach;
      x_[count_] = g.centreX(ix);
      y_[count_] = g.centreY(iy);
      height_[count_] = grid.heights[i];
      ++count_;
    }
  }
}

std::optional<FloorSlope> NearFloor::fit(const std::vector<std::uint8_t>& is_floor,
                                         const FloorGrid& grid) {
  gather(is_floor, grid);
  if (count_ < kFewestCells) return std::nullopt;
  const float nearest = x_[0];
  std::optional<FloorSlope> found;
  FloorSlope plane;
  for (const Round& round : kRounds) {
    const auto* end = std::upper_bound(x_.data(), x_.data() + count_, nearest + round.reach);
    const auto n = static_cast<Eigen::Index>(end - x_.data());
    const auto x = x_.head(n), y = y_.head(n), h = height_.head(n);
    auto w = weight_.head(n);
    const auto at_origin = static_cast<float>(plane.height);
    const auto slope_x = static_cast<float>(plane.slope_x);
    const auto slope_y = static_cast<float>(plane.slope_y);
    // Tukey's biweight of the residual over the gate.
    w = (1.0F - ((h - at_origin - slope_x * x - slope_y * y) / round.gate).square())
            .max(0.0F)
            .square();
    // A floor too rough for the narrow gates keeps what the wide ones found.
    if ((w > 0.0F).count() < kFewestCells) break;
    const Eigen::Vector3d wxy(w.sum(), (w * x).sum(), (w * y).sum());
    Eigen::Matrix3d a;
    a.col(0) = wxy;
    a.row(0) = wxy.transpose();
    a(1, 1) = (w * x * x).sum();
    a(1, 2) = a(2, 1) = (w * x * y).sum();
    a(2, 2) = (w * y * y).sum();
    const Eigen::Vector3d b((w * h).sum(), (w * x * h).sum(), (w * y * h).sum());
    const Eigen::Vector3d solution = a.ldlt().solve(b);
    if (!solution.allFinite()) break;
    plane = FloorSlope{solution[0], solution[1], solution[2]};
    found = plane;
  }
  return found;
}

}  // namespace pilothouse
