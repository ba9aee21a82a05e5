#include "core/floor/floor_surface.hpp"

#include <algorithm>
#include <cstring>

namespace pilothouse {
namespace {

constexpr int kBlock = 6;           // cells a side
constexpr double kFewestCells = 6;  // below, a fit says nothing
// Pulls slopes to the whole floor's where the cells lie on a line; as strong as a few cells that
// lie 10 cm apart.
constexpr double kSlopePrior = 0.05;

inline float masked(float value, std::uint32_t mask) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  bits &= mask;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

}  // namespace

void FloorSurface::configure(const GridGeometry& geometry) {
  geometry_ = geometry;
  blocks_x_ = (geometry.size_x + kBlock - 1) / kBlock;
  blocks_y_ = (geometry.size_y + kBlock - 1) / kBlock;
  const auto blocks = static_cast<std::size_t>(blocks_x_) * static_cast<std::size_t>(blocks_y_);
  sums_.assign(blocks, Sums::Zero());
  planes_.assign(blocks, LocalPlane{});
  for (auto& sums : column_sums_) sums.assign(static_cast<std::size_t>(geometry.size_x), 0.0F);
  whole_ = FloorSlope{};
}

void FloorSurface::fit(const std::vector<std::uint8_t>& is_floor,
                       const std::vector<float>& heights) {
  for (int by = 0; by < blocks_y_; ++by) {
    for (auto& sums : column_sums_) std::fill(sums.begin(), sums.end(), 0.0F);
    const int end = std::min((by + 1) * kBlock, geometry_.size_y);
    for (int iy = by * kBlock; iy < end; ++iy) sumColumns(iy, is_floor, heights);
    for (int bx = 0; bx < blocks_x_; ++bx) {
      sums_[static_cast<std::size_t>(by * blocks_x_ + bx)] = sumOfBlock(bx);
    }
  }
  refit();
}

/// Adds a row of cells to the sums of their columns: n, y, yy, h, yh. No branch, so that it becomes
/// vector code.
void FloorSurface::sumColumns(int iy, const std::vector<std::uint8_t>& is_floor,
                              const std::vector<float>& heights) {
  const std::size_t first = geometry_.index(0, iy);
  const std::uint8_t* floor = is_floor.data() + first;
  const float* height = heights.data() + first;
  const float y = geometry_.centreY(iy);
  float* n = column_sums_[0].data();
  float* sy = column_sums_[1].data();
  float* syy = column_sums_[2].data();
  float* sh = column_sums_[3].data();
  float* syh = column_sums_[4].data();
#pragma GCC ivdep  // the arrays are apart, which bytes that may alias anything hide
  for (int ix = 0; ix < geometry_.size_x; ++ix) {
    // Where it is not floor the height may be NaN: its bits are cleared, not multiplied away.
    const std::uint32_t mask = floor[ix] != 0 ? ~0U : 0U;
    const float one = masked(1.0F, mask);
    const float h = masked(height[ix], mask);
    n[ix] += one;
    sy[ix] += one * y;
    syy[ix] += one * (y * y);
    sh[ix] += h;
    syh[ix] += h * y;
  }
}

FloorSurface::Sums FloorSurface::sumOfBlock(int bx) const {
  Sums sums = Sums::Zero();
  const int end = std::min((bx + 1) * kBlock, geometry_.size_x);
  for (int ix = bx * kBlock; ix < end; ++ix) {
    const auto i = static_cast<std::size_t>(ix);
    const double x = geometry_.centreX(ix);
    const double n = column_sums_[0][i], sy = column_sums_[1][i], sh = column_sums_[3][i];
    Sums column;
    column << n, n * x, sy, n * x * x, sy * x, column_sums_[2][i], sh, sh * x, column_sums_[4][i];
    sums += column;
  }
  return sums;
}

void FloorSurface::add(const std::uint32_t* cells, std::size_t count,
                       const std::vector<float>& heights) {
  for (std::size_t k = 0; k < count; ++k) {
    const auto cell = static_cast<int>(cells[k]);
    const int ix = cell % geometry_.size_x, iy = cell / geometry_.size_x;
    const double x = geometry_.centreX(ix), y = geometry_.centreY(iy), h = heights[cells[k]];
    Sums sums;
    sums << 1.0, x, y, x * x, x * y, y * y, h, x * h, y * h;
    sums_[static_cast<std::size_t>((iy / kBlock) * blocks_x_ + ix / kBlock)] += sums;
  }
}

void FloorSurface::refit() {
  Sums all = Sums::Zero();
  for (const Sums& s : sums_) all += s;
  whole_ = all[0] >= kFewestCells ? solve(all, FloorSlope{}) : FloorSlope{};
  for (LocalPlane& plane : planes_) plane.solved = false;
}

FloorSlope FloorSurface::solve(const Sums& s, const FloorSlope& prior) {
  // About the centroid, as the difference to the prior's slopes.
  const double n = s[0];
  const double mx = s[1] / n, my = s[2] / n, mh = s[6] / n;
  const double cxx = s[3] - n * mx * mx, cxy = s[4] - n * mx * my, cyy = s[5] - n * my * my;
  const double cxh = s[7] - n * mx * mh - prior.slope_x * cxx - prior.slope_y * cxy;
  const double cyh = s[8] - n * my * mh - prior.slope_x * cxy - prior.slope_y * cyy;
  const double axx = cxx + kSlopePrior, ayy = cyy + kSlopePrior;
  const double determinant = axx * ayy - cxy * cxy;  // positive: Cauchy-Schwarz and the prior
  FloorSlope plane;
  plane.slope_x = prior.slope_x + (ayy * cxh - cxy * cyh) / determinant;
  plane.slope_y = prior.slope_y + (axx * cyh - cxy * cxh) / determinant;
  plane.height = mh - plane.slope_x * mx - plane.slope_y * my;
  return plane;
}

const FloorSurface::LocalPlane& FloorSurface::local(int bx, int by) {
  const auto block = static_cast<std::size_t>(by * blocks_x_ + bx);
  LocalPlane& plane = planes_[block];
  if (plane.solved) return plane;
  FloorSlope slope = whole_;
  for (int radius = 1; radius <= 2; ++radius) {
    Sums sums = Sums::Zero();
    for (int y = std::max(0, by - radius); y <= std::min(blocks_y_ - 1, by + radius); ++y) {
      for (int x = std::max(0, bx - radius); x <= std::min(blocks_x_ - 1, bx + radius); ++x) {
        sums += sums_[static_cast<std::size_t>(y * blocks_x_ + x)];
      }
    }
    if (sums[0] < kFewestCells) continue;
    slope = solve(sums, whole_);
    break;
  }
  plane = {static_cast<float>(slope.height), static_cast<float>(slope.slope_x),
           static_cast<float>(slope.slope_y), true};
  return plane;
}

float FloorSurface::expected(int ix, int iy) {
  const LocalPlane& plane = local(ix / kBlock, iy / kBlock);
  return plane.height + plane.slope_x * geometry_.centreX(ix) +
         plane.slope_y * geometry_.centreY(iy);
}

}  // namespace pilothouse
