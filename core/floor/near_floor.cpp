#include "core/floor/near_floor.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

namespace pilothouse {
namespace {

struct Round {
  double reach;  // floor used beyond the nearest cell [m]
  double gate;   // residuals beyond weigh nothing [m]
};
constexpr std::array<Round, 7> kRounds = {
    {{0.4, 1e3}, {0.4, 0.02}, {0.4, 0.01}, {0.6, 0.008}, {0.9, 0.006}, {1.2, 0.006}, {1.2, 0.006}}};
constexpr int kFewestCells = 60;

}  // namespace

void NearFloor::configure(const GridGeometry& geometry) {
  cells_.reserve(geometry.cells());
}

void NearFloor::gather(const std::vector<std::uint8_t>& is_floor, const FloorGrid& grid) {
  const GridGeometry& g = grid.geometry;
  int nearest = g.size_x;
  for (int iy = 0; iy < g.size_y; ++iy) {
    for (int ix = 0; ix < nearest; ++ix) {
      if (is_floor[g.index(ix, iy)] != 0) nearest = ix;
    }
  }
  const auto reach = static_cast<int>(std::lround(kRounds.back().reach / g.cell_size));
  const int end = std::min(g.size_x, nearest + reach);
  nearest_x_ = g.centreX(nearest);
  cells_.clear();
  for (int iy = 0; iy < g.size_y; ++iy) {
    for (int ix = nearest; ix < end; ++ix) {
      const std::size_t i = g.index(ix, iy);
      if (is_floor[i] != 0) cells_.emplace_back(g.centreX(ix), g.centreY(iy), grid.heights[i]);
    }
  }
}

std::optional<FloorSlope> NearFloor::fit(const std::vector<std::uint8_t>& is_floor,
                                         const FloorGrid& grid) {
  gather(is_floor, grid);
  FloorSlope plane;
  for (const Round& round : kRounds) {
    const float end = nearest_x_ + static_cast<float>(round.reach);
    Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
    Eigen::Vector3d b = Eigen::Vector3d::Zero();
    int used = 0;
    for (const Eigen::Vector3f& cell : cells_) {
      if (cell.x() > end) continue;
      const Eigen::Vector3d v(1.0, cell.x(), cell.y());
      const double h = cell.z();
      const double t = (h - plane.at(v.y(), v.z())) / round.gate;
      if (std::abs(t) >= 1.0) continue;
      const double w = (1.0 - t * t) * (1.0 - t * t);  // Tukey's biweight
      a += (w * v) * v.transpose();
      b += (w * h) * v;
      ++used;
    }
    if (used < kFewestCells) return std::nullopt;
    const Eigen::Vector3d solution = a.ldlt().solve(b);
    if (!solution.allFinite()) return std::nullopt;
    plane = FloorSlope{solution[0], solution[1], solution[2]};
  }
  return plane;
}

}  // namespace pilothouse
