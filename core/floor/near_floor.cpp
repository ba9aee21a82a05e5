#include "core/floor/near_floor.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace pilothouse {
namespace {

// Bands of floor beyond the nearest cell from which a fit may start [m]: more than one, because a
// sill or the foot of a ramp may lie in any. The start that most cells agree with wins.
struct Band {
  float begin, end;
};
constexpr std::array<Band, 4> kStarts = {
    {{0.0F, 0.2F}, {0.0F, 0.4F}, {0.15F, 0.45F}, {0.3F, 0.8F}}};
constexpr float kStartGate = 0.01F;   // residuals beyond weigh nothing in the second pass [m]
constexpr float kAgreement = 0.004F;  // a cell agrees with a start this near to it [m]
constexpr float kAgreementReach = 0.8F;

// From there the fit grows outward; what leaves the plane falls out of the gate.
struct Round {
  float reach;  // floor used beyond the nearest cell [m]
  float gate;   // residuals beyond weigh nothing [m]
};
constexpr std::array<Round, 5> kRounds = {
    {{0.4F, 0.008F}, {0.6F, 0.006F}, {0.9F, 0.004F}, {1.2F, 0.004F}, {1.2F, 0.004F}}};
constexpr Eigen::Index kFewestCells = 60;
constexpr float kNoGate = 1e3F;
// It passes so near below the base's origin [m]: a ramp that fills the view does not. More than the
// camera's height may be wrong, less than a ramp's foot a step ahead is off.
constexpr double kAtFeet = 0.035;

}  // namespace

void NearFloor::configure(const GridGeometry& geometry) {
  const auto cells = static_cast<Eigen::Index>(geometry.cells());
  x_.resize(cells);
  y_.resize(cells);
  height_.resize(cells);
  weight_.resize(cells);
}

/// Lists the floor cells within the last round's reach, nearest first.
void NearFloor::gather(const std::vector<std::uint8_t>& is_floor, const FloorCells& grid) {
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

/// Cells [first, last) lie in a band beyond the nearest.
NearFloor::Range NearFloor::range(float begin, float end) const {
  const float* x = x_.data();
  const auto* first = std::lower_bound(x, x + count_, x_[0] + begin);
  const auto* last = std::upper_bound(first, x + count_, x_[0] + end);
  return {first - x, last - first};
}

/// One weighted least squares round (Tukey's biweight of the residual from `from` over the gate).
std::optional<FloorSlope> NearFloor::solve(Range range, const FloorSlope& from, float gate) {
  const auto x = x_.segment(range.first, range.count);
  const auto y = y_.segment(range.first, range.count);
  const auto h = height_.segment(range.first, range.count);
  auto w = weight_.head(range.count);
  w = (1.0F - (residuals(range, from) / gate).square()).max(0.0F).square();
  if ((w > 0.0F).count() < kFewestCells) return std::nullopt;
  Eigen::Matrix3d a;
  a.col(0) = Eigen::Vector3d(w.sum(), (w * x).sum(), (w * y).sum());
  a.row(0) = a.col(0).transpose();
  a(1, 1) = (w * x * x).sum();
  a(1, 2) = a(2, 1) = (w * x * y).sum();
  a(2, 2) = (w * y * y).sum();
  const Eigen::Vector3d b((w * h).sum(), (w * x * h).sum(), (w * y * h).sum());
  const Eigen::Vector3d solution = a.ldlt().solve(b);
  if (!solution.allFinite()) return std::nullopt;
  return FloorSlope{solution[0], solution[1], solution[2]};
}

/// Of the level floor and what the bands make of it, the plane that most cells agree with, those
/// first that pass below the robot's feet.
std::optional<FloorSlope> NearFloor::start() {
  std::optional<FloorSlope> best;
  Eigen::Index most = 0;
  bool best_at_feet = false;
  const Range all = range(0.0F, kAgreementReach);
  const auto propose = [&](const FloorSlope& plane) {
    const Eigen::Index agree = (residuals(all, plane).abs() < kAgreement).count();
    const bool at_feet = std::abs(plane.height) <= kAtFeet;
    if (at_feet == best_at_feet ? agree <= most : best_at_feet) return;
    if (agree < kFewestCells && best) return;
    best = plane;
    most = agree;
    best_at_feet = at_feet;
  };
  for (const Band& band : kStarts) {
    const Range some = range(band.begin, band.end);
    auto plane = solve(some, FloorSlope{}, kNoGate);
    if (plane) plane = solve(some, *plane, kStartGate);
    if (plane) propose(*plane);
  }
  const FloorSlope level;
  if ((residuals(all, level).abs() < kAgreement).count() >= kFewestCells) propose(level);
  return best;
}

std::optional<FloorSlope> NearFloor::fit(const std::vector<std::uint8_t>& is_floor,
                                         const FloorCells& grid) {
  gather(is_floor, grid);
  if (count_ < kFewestCells) return std::nullopt;
  std::optional<FloorSlope> plane = start();
  for (const Round& round : kRounds) {
    if (!plane) break;
    // A floor too rough for the narrow gates keeps what the wide ones found.
    const auto finer = solve(range(0.0F, round.reach), *plane, round.gate);
    if (!finer) break;
    plane = finer;
  }
  return plane;
}

}  // namespace pilothouse
