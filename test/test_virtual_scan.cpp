#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/floor/virtual_scan.hpp"
#include "test/random_grid.hpp"

namespace pilothouse {
namespace {

constexpr double kPi = 3.14159265358979323846;

FloorCells gridOf(CellClass everywhere) {
  FloorCells grid;
  grid.geometry = {0.2F, -2.5F, 0.05F, 76, 100};
  grid.classes.assign(grid.geometry.cells(), everywhere);
  return grid;
}

std::size_t beamAt(const ScanGeometry& scan, double bearing) {
  return static_cast<std::size_t>(
      std::lround((bearing - double{scan.angle_min}) / double{scan.increment}));
}

TEST(VirtualScan, FreeFloorIsInfiniteUnknownIsNoMeasurement) {
  VirtualScan scan;
  const auto free = scan.scan(gridOf(CellClass::kFloor));
  EXPECT_EQ(free[beamAt(scan.geometry(), 0.0)], std::numeric_limits<float>::infinity());
  EXPECT_EQ(scan.scan(gridOf(CellClass::kThreshold))[beamAt(scan.geometry(), 0.3)],
            std::numeric_limits<float>::infinity());
  for (const float range : scan.scan(gridOf(CellClass::kUnknown))) EXPECT_TRUE(std::isnan(range));
}

TEST(VirtualScan, AnObstacleOrDropOffIsSeenAtItsNearEdgeAndOnlyThere) {
  VirtualScan scan;
  for (const CellClass kind : {CellClass::kObstacle, CellClass::kDropOff}) {
    FloorCells grid = gridOf(CellClass::kFloor);
    grid.classes[grid.geometry.index(16, 50)] = kind;  // x 1.00..1.05, y 0..0.05
    const auto ranges = scan.scan(grid);
    EXPECT_NEAR(ranges[beamAt(scan.geometry(), std::atan2(0.025, 1.025))], 1.0, 1e-5);
    EXPECT_TRUE(std::isinf(ranges[beamAt(scan.geometry(), std::atan2(0.08, 1.0))]));
    EXPECT_TRUE(std::isinf(ranges[beamAt(scan.geometry(), std::atan2(-0.03, 1.0))]));
  }
}

TEST(VirtualScan, TheNearerOfTwoWins) {
  VirtualScan scan;
  FloorCells grid = gridOf(CellClass::kFloor);
  for (const int ix : {60, 16, 40})
    grid.classes[grid.geometry.index(ix, 50)] = CellClass::kObstacle;
  EXPECT_NEAR(scan.scan(grid)[beamAt(scan.geometry(), 0.025)], 1.0, 1e-5);
}

TEST(VirtualScan, InsideAnObstacleEverythingIsTooClose) {
  VirtualScan scan;
  FloorCells grid;
  grid.geometry = {-0.25F, -0.25F, 0.1F, 5, 5};
  grid.classes.assign(25, CellClass::kFloor);
  grid.classes[grid.geometry.index(2, 2)] = CellClass::kObstacle;
  const auto& ranges = scan.scan(grid);
  EXPECT_EQ(scan.geometry().beams, 720) << "a grid all round needs the full turn";
  for (const float range : ranges) EXPECT_EQ(range, -std::numeric_limits<float>::infinity());
}

// ---- the same by definition: clip every cell with every beam's sector

struct Point {
  double x, y;
};

/// The part of a convex polygon where normal . p >= 0.
std::vector<Point> clip(const std::vector<Point>& polygon, Point normal) {
  std::vector<Point> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    const double da = normal.x * a.x + normal.y * a.y, db = normal.x * b.x + normal.y * b.y;
    if (da >= 0.0) kept.push_back(a);
    if ((da > 0.0 && db < 0.0) || (da < 0.0 && db > 0.0)) {
      const double t = da / (da - db);
      kept.push_back({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
    }
  }
  return kept;
}

bool touches(double x0, double x1, double y0, double y1, double low, double high) {
  std::vector<Point> polygon{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
  polygon = clip(polygon, {-std::sin(low), std::cos(low)});    // left of the sector's right edge
  polygon = clip(polygon, {std::sin(high), -std::cos(high)});  // right of its left edge
  return !polygon.empty();
}

/// @param margin the sector is widened by this (may be negative) [rad].
float rangeByDefinition(const FloorCells& grid, double bearing, double half, double margin) {
  const GridGeometry& g = grid.geometry;
  double nearest = std::numeric_limits<double>::infinity();
  bool seen = false;
  for (int iy = 0; iy < g.size_y; ++iy) {
    for (int ix = 0; ix < g.size_x; ++ix) {
      const CellClass c = grid.classes[g.index(ix, iy)];
      if (c == CellClass::kUnknown) continue;
      const double x0 = double{g.x_min} + ix * double{g.cell_size}, x1 = x0 + g.cell_size;
      const double y0 = double{g.y_min} + iy * double{g.cell_size}, y1 = y0 + g.cell_size;
      const double distance = std::hypot(std::max({0.0, x0, -x1}), std::max({0.0, y0, -y1}));
      const double low = bearing - half - margin, high = bearing + half + margin;
      if (distance > 0.0 && !touches(x0, x1, y0, y1, low, high)) continue;
      seen = true;
      if (!isDrivable(c)) nearest = std::min(nearest, distance);
    }
  }
  if (!seen) return std::numeric_limits<float>::quiet_NaN();
  if (nearest == 0.0) return -std::numeric_limits<float>::infinity();
  return static_cast<float>(nearest);
}

bool same(float a, float b) {
  return (std::isnan(a) && std::isnan(b)) || a == b || std::abs(a - b) <= 1e-5F * std::abs(b);
}

TEST(VirtualScan, AgreesWithTheDefinitionOnRandomGrids) {
  std::mt19937 random(11);
  VirtualScan scan;
  int compared = 0, on_the_edge = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const FloorCells grid = randomGrid(random);
    const auto& ranges = scan.scan(grid);
    const ScanGeometry& g = scan.geometry();
    ASSERT_EQ(ranges.size(), static_cast<std::size_t>(g.beams));
    for (int beam = 0; beam < g.beams; beam += 7) {
      const double bearing = double{g.angle_min} + beam * 2.0 * kPi / 720.0;
      const double half = kPi / 720.0;
      const float range = ranges[static_cast<std::size_t>(beam)];
      // A cell's corner may lie on the edge of a sector: either answer is right there.
      const float wide = rangeByDefinition(grid, bearing, half, 1e-6);
      const float tight = rangeByDefinition(grid, bearing, half, -1e-6);
      ++compared;
      if (!same(wide, tight)) ++on_the_edge;
      EXPECT_TRUE(same(range, wide) || same(range, tight))
          << "trial " << trial << " beam " << beam << ": " << range << ", by definition " << wide
          << " or " << tight;
    }
  }
  EXPECT_LT(on_the_edge * 100, compared) << "the margin hides too much";
}

}  // namespace
}  // namespace pilothouse
