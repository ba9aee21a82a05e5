#include "core/floor/virtual_scan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pilothouse {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kBeams = 720;  // half a degree: a cell of 5 cm at 5.7 m

bool sameGeometry(const GridGeometry& a, const GridGeometry& b) {
  return a.x_min == b.x_min && a.y_min == b.y_min && a.cell_size == b.cell_size &&
         a.size_x == b.size_x && a.size_y == b.size_y;
}

/// How far 0 is from the interval low..high.
double distanceToInterval(double low, double high) {
  return std::max({0.0, low, -high});
}

}  // namespace

void VirtualScan::prepare(const GridGeometry& grid) {
  grid_ = grid;
  const double x_max = grid.x_min + grid.size_x * double{grid.cell_size};
  const double y_max = grid.y_min + grid.size_y * double{grid.cell_size};
  scan_.increment = static_cast<float>(2.0 * kPi / kBeams);
  // A grid that lies ahead needs the front half only; one around the robot the full turn.
  scan_.beams = grid.x_min >= 0.0F ? kBeams / 2 : kBeams;
  scan_.angle_min = -0.5F * scan_.increment * static_cast<float>(scan_.beams - 1);
  scan_.range_max =
      static_cast<float>(std::hypot(std::max(std::abs(double{grid.x_min}), std::abs(x_max)),
                                    std::max(std::abs(double{grid.y_min}), std::abs(y_max))));
  ranges_.assign(static_cast<std::size_t>(scan_.beams), 0.0F);
  sectors_.resize(grid.cells());
  for (int iy = 0; iy < grid.size_y; ++iy) {
    for (int ix = 0; ix < grid.size_x; ++ix) sectors_[grid.index(ix, iy)] = sectorOf(grid, ix, iy);
  }
}

VirtualScan::Sector VirtualScan::sectorOf(const GridGeometry& grid, int ix, int iy) const {
  const double x0 = grid.x_min + ix * double{grid.cell_size}, x1 = x0 + grid.cell_size;
  const double y0 = grid.y_min + iy * double{grid.cell_size}, y1 = y0 + grid.cell_size;
  Sector sector;
  sector.distance =
      static_cast<float>(std::hypot(distanceToInterval(x0, x1), distanceToInterval(y0, y1)));
  if (sector.distance == 0.0F) {
    sector.count = static_cast<std::uint16_t>(scan_.beams);
    return sector;
  }
  // Angles of the corners around that of the centre, so that none wraps.
  const double centre = std::atan2(0.5 * (y0 + y1), 0.5 * (x0 + x1));
  double low = 0.0, high = 0.0;
  for (const double x : {x0, x1}) {
    for (const double y : {y0, y1}) {
      const double turn = std::remainder(std::atan2(y, x) - centre, 2.0 * kPi);
      low = std::min(low, turn);
      high = std::max(high, turn);
    }
  }
  const double begin = 0.5 * scan_.increment - double{scan_.angle_min};
  const double increment = 2.0 * kPi / kBeams;
  auto first = static_cast<int>(std::floor((centre + low + begin) / increment));
  auto last = static_cast<int>(std::floor((centre + high + begin) / increment));
  if (scan_.beams < kBeams) {
    first = std::clamp(first, 0, scan_.beams - 1);
    last = std::clamp(last, 0, scan_.beams - 1);
  }
  sector.count = static_cast<std::uint16_t>(std::min(last - first + 1, scan_.beams));
  sector.first = static_cast<std::uint16_t>((first + scan_.beams) % scan_.beams);
  return sector;
}

const std::vector<float>& VirtualScan::scan(const FloorCells& grid) {
  constexpr float kFree = std::numeric_limits<float>::infinity();
  constexpr float kUnseen = std::numeric_limits<float>::quiet_NaN();
  if (!sameGeometry(grid.geometry, grid_)) prepare(grid.geometry);
  std::fill(ranges_.begin(), ranges_.end(), kUnseen);
  for (std::size_t i = 0; i < sectors_.size(); ++i) {
    const CellClass kind = grid.classes[i];
    if (kind == CellClass::kUnknown) continue;
    const float range = isDrivable(kind) ? kFree : sectors_[i].distance;
    int beam = sectors_[i].first;
    for (int n = sectors_[i].count; n > 0; --n) {
      float& nearest = ranges_[static_cast<std::size_t>(beam)];
      if (!(nearest <= range)) nearest = range;  // also replaces NaN
      if (++beam == scan_.beams) beam = 0;
    }
  }
  for (float& range : ranges_) {
    if (range == 0.0F) range = -kFree;
  }
  return ranges_;
}

}  // namespace pilothouse
