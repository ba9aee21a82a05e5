// The log-odds map of the floor: what it learns from grids, objects and scans.

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "core/mapping/occupancy_map.hpp"
#include "core/mapping/occupancy_reference.hpp"
#include "test/random_grid.hpp"

namespace pilothouse {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

FloorFrame frameOf(const FloorCells& grid) {
  return {0.0, grid.geometry, grid.classes.data(), grid.heights.data()};
}

/// Floor before the robot, x 0.2..3, y -1..1.
FloorCells openFloor() {
  FloorCells grid;
  grid.geometry = {0.2F, -1.0F, 0.05F, 56, 40};
  grid.classes.assign(grid.geometry.cells(), CellClass::kFloor);
  grid.heights.assign(grid.geometry.cells(), 0.0F);
  return grid;
}
void put(FloorCells& grid, double x0, double y0, double x1, double y1, CellClass kind) {
  const GridGeometry& g = grid.geometry;
  for (int iy = 0; iy < g.size_y; ++iy) {
    for (int ix = 0; ix < g.size_x; ++ix) {
      const double x = static_cast<double>(g.centreX(ix)), y = static_cast<double>(g.centreY(iy));
      if (x > x0 && x < x1 && y > y0 && y < y1) grid.classes[g.index(ix, iy)] = kind;
    }
  }
}
MapCell at(const OccupancyMap& map, double x, double y) {
  return map.at(map.cellOf(x, y));
}
void look(OccupancyMap& map, const FloorCells& grid, int times, const Pose2& pose = {}) {
  for (int i = 0; i < times; ++i) ASSERT_EQ(map.addFloor(frameOf(grid), pose), nullptr);
}
PlanarScan scanOf(const std::vector<float>& ranges) {
  PlanarScan scan;
  scan.angle_min = -M_PI;
  scan.increment = 2.0 * M_PI / static_cast<double>(ranges.size());
  scan.range_max = 10.0;
  scan.ranges = ranges.data();
  scan.count = ranges.size();
  return scan;
}

void expectSame(const OccupancyMap& map, const OccupancyReference& reference) {
  std::size_t known = 0;
  for (const auto& cell : reference.cells()) {
    const MapCellState state = map.state({cell.first.first, cell.first.second});
    ASSERT_EQ(state.odds, cell.second.odds) << cell.first.first << " " << cell.first.second;
    ASSERT_EQ(state.threshold, cell.second.threshold);
    ASSERT_EQ(state.drop_off, cell.second.drop_off);
    known += cell.second != MapCellState{} ? 1 : 0;
  }
  std::size_t kept = 0;
  map.forEachBlock([&](int, int, const OccupancyMap::Block& block) {
    for (const auto& cell : block) kept += cell != MapCellState{} ? 1 : 0;
  });
  ASSERT_EQ(kept, known) << "the map knows cells that the reference does not";
}

class OccupancyRandom : public ::testing::TestWithParam<unsigned> {};

TEST_P(OccupancyRandom, LearnsWhatThePlainVersionLearns) {
  std::mt19937 random(GetParam());
  const auto uniform = [&random](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  OccupancyParameters parameters;
  parameters.cell_size = uniform(0.02, 0.2);
  parameters.reach = uniform(1.0, 6.0);
  parameters.clear_range = uniform(0.0, 5.0);
  parameters.max_side = 12.0;  // the frames leave it
  OccupancyMap map(parameters);
  OccupancyReference reference(parameters);
  Pose2 pose;
  for (int frame = 0; frame < 12; ++frame) {
    pose = {pose.x + uniform(-0.3, 0.3), pose.y + uniform(-0.3, 0.3), uniform(-4.0, 4.0)};
    const FloorCells grid = randomGrid(random);
    std::vector<float> ranges(60);
    for (float& range : ranges) {
      const int kind = std::uniform_int_distribution<int>(0, 9)(random);
      range = kind == 0 ? kNan : kind == 1 ? kInfinity : static_cast<float>(uniform(-0.5, 12.0));
    }
    PlanarScan scan = scanOf(ranges);
    scan.T_base_scan = {uniform(-0.3, 0.3), uniform(-0.3, 0.3), uniform(-3.0, 3.0)};
    std::vector<Obstacle> objects(5);
    for (auto& object : objects) {
      object.position = Eigen::Vector2f::Random() * 3.0F;
      object.size = static_cast<float>(uniform(0.0, 0.5));
      object.kind = static_cast<CellClass>(std::uniform_int_distribution<int>(2, 4)(random));
    }
    ASSERT_EQ(map.addFloor(frameOf(grid), pose), nullptr);
    ASSERT_EQ(map.addScan(scan, pose), nullptr);
    ASSERT_EQ(map.addObjects(objects, pose), nullptr);
    reference.addFloor(frameOf(grid), pose);
    reference.addScan(scan, pose);
    reference.addObjects(objects, pose);
    ASSERT_NO_FATAL_FAILURE(expectSame(map, reference)) << "frame " << frame;
  }
}
INSTANTIATE_TEST_SUITE_P(Seeds, OccupancyRandom, ::testing::Range(1U, 21U));

TEST(OccupancyMap, KeepsThresholdsAndDropOffsAsSuch) {
  OccupancyMap map({});
  FloorCells grid = openFloor();
  put(grid, 1.0, -0.2, 1.2, 0.2, CellClass::kThreshold);
  put(grid, 2.0, -1.0, 2.4, 1.0, CellClass::kDropOff);
  look(map, grid, 3);
  EXPECT_EQ(at(map, 0.51, 0.01), MapCell::kFree);
  EXPECT_EQ(at(map, 1.11, 0.01), MapCell::kThreshold);
  EXPECT_EQ(at(map, 2.21, 0.01), MapCell::kDropOff);
  EXPECT_EQ(at(map, -0.51, 0.01), MapCell::kUnknown) << "behind the robot";
}

TEST(OccupancyMap, ObstaclesOfTheGridAlonePassAndObjectsStay) {
  OccupancyMap map({});
  FloorCells grid = openFloor();
  put(grid, 1.0, -0.1, 1.2, 0.1, CellClass::kObstacle);
  look(map, grid, 50);
  EXPECT_EQ(at(map, 1.11, 0.01), MapCell::kUnknown) << "it may be somebody who goes on";
  look(map, openFloor(), 2);
  EXPECT_EQ(at(map, 1.11, 0.01), MapCell::kFree);
  Obstacle object;
  object.position = {1.11F, 0.01F};
  object.size = 0.2F;
  for (int i = 0; i < 3; ++i) ASSERT_EQ(map.addObjects({object}, {}), nullptr);
  EXPECT_EQ(at(map, 1.11, 0.01), MapCell::kOccupied);
  EXPECT_EQ(at(map, 1.18, 0.01), MapCell::kOccupied) << "as large as it is";
  EXPECT_EQ(at(map, 1.26, 0.01), MapCell::kFree);
}

// The rim of a thing is seen now as an obstacle, now as floor.
TEST(OccupancyMap, WhatStaysAndIsSeenAgainDoesNotFade) {
  OccupancyMap map({});
  map.set({map.cellOf(1.51, 0.01)}, MapCell::kOccupied);
  FloorCells thing = openFloor();
  put(thing, 1.5, 0.0, 1.55, 0.05, CellClass::kObstacle);
  for (int i = 0; i < 20; ++i) {
    look(map, thing, 1);
    look(map, openFloor(), 1);
    EXPECT_EQ(at(map, 1.51, 0.01), MapCell::kOccupied);
  }
}

TEST(OccupancyMap, ThreeLooksAtFreeFloorClearWhatStood) {
  OccupancyMap map({});
  map.set({map.cellOf(1.51, 0.01)}, MapCell::kOccupied);
  look(map, openFloor(), 2);
  EXPECT_NE(at(map, 1.51, 0.01), MapCell::kFree);
  look(map, openFloor(), 1);
  EXPECT_EQ(at(map, 1.51, 0.01), MapCell::kFree);
}

// A box at the near rim: its front is nearer than the camera sees, only its foot shows, as floor.
TEST(OccupancyMap, KeepsWhatShowsOnlyItsFoot) {
  OccupancyMap map({});
  map.set({map.cellOf(1.01, 0.01)}, MapCell::kOccupied);
  FloorCells foot = openFloor();
  put(foot, 1.06, -0.3, 3.0, 0.3, CellClass::kUnknown);
  look(map, foot, 20);
  EXPECT_EQ(at(map, 1.01, 0.01), MapCell::kOccupied);
}

TEST(OccupancyMap, ScanClearsToItsEndAndMarksIt) {
  OccupancyMap map({});
  const std::vector<float> ranges(720, 2.0F);
  for (int i = 0; i < 3; ++i) ASSERT_EQ(map.addScan(scanOf(ranges), {}), nullptr);
  EXPECT_EQ(at(map, 1.0, 0.7), MapCell::kFree);
  EXPECT_EQ(at(map, 2.0 * std::cos(0.25 * M_PI), 2.0 * std::sin(0.25 * M_PI)), MapCell::kOccupied);
  EXPECT_EQ(at(map, 1.6, 1.6), MapCell::kUnknown);
}

TEST(OccupancyMap, BeamWithoutReturnClearsOnlySoFarAndNanNothing) {
  OccupancyParameters parameters;
  parameters.clear_range = 3.0;
  OccupancyMap map(parameters);
  std::vector<float> ranges(720, kInfinity);
  for (std::size_t i = 0; i < 360; ++i) ranges[i] = kNan;  // bearings below zero
  for (int i = 0; i < 3; ++i) ASSERT_EQ(map.addScan(scanOf(ranges), {}), nullptr);
  EXPECT_EQ(at(map, 0.0, 2.5), MapCell::kFree);
  EXPECT_EQ(at(map, 0.0, 3.3), MapCell::kUnknown) << "beyond clear_range";
  EXPECT_EQ(at(map, 0.0, -2.5), MapCell::kUnknown) << "NaN is no measurement";
  // What stood there is gone once a beam passes it, though nothing behind it sends anything back.
  map.set({map.cellOf(0.0, 1.5)}, MapCell::kOccupied);
  for (int i = 0; i < 3; ++i) ASSERT_EQ(map.addScan(scanOf(ranges), {}), nullptr);
  EXPECT_EQ(at(map, 0.0, 1.5), MapCell::kFree);
}

TEST(OccupancyMap, ReachesRoundTheRobotWhereverItStands) {
  for (const double x : {-0.81, -0.01, 0.0, 0.79}) {
    for (const double heading : {0.0, 2.5}) {
      OccupancyMap map({});
      look(map, openFloor(), 1, {x, -0.01, heading});
      MapCells cells;
      map.snapshot(cells);
      for (const double side : {-0.4, 0.4}) {
        EXPECT_TRUE(cells.contains(cells.column(x + side), cells.row(-0.01 - side)))
            << x << " " << heading;
      }
    }
  }
}

TEST(OccupancyMap, RefusesPosesAndGrowsNoFartherThanItsSquare) {
  OccupancyParameters parameters;
  parameters.max_side = 4.0;
  OccupancyMap map(parameters);
  const FloorCells grid = openFloor();
  EXPECT_NE(map.addFloor(frameOf(grid), {std::nan(""), 0.0, 0.0}), nullptr);
  EXPECT_NE(map.addFloor(frameOf(grid), {1e300, 0.0, 0.0}), nullptr);
  EXPECT_NE(map.addFloor(frameOf(grid), {2.1, 0.0, 0.0}), nullptr);
  EXPECT_EQ(map.blockCount(), 0U) << "a refused frame changes nothing";
  EXPECT_EQ(map.addFloor(frameOf(grid), {1.5, 0.0, 0.0}), nullptr);
  EXPECT_GT(map.refusedCells(), 0U) << "told, not silent";
  MapCells cells;
  map.snapshot(cells);
  EXPECT_LE(cells.origin_x + cells.size_x * cells.cell_size, 2.4 + 1e-9) << "to the block's end";
}

TEST(OccupancyMap, SnapshotTellsWhatTheCellsTell) {
  OccupancyMap map({});
  FloorCells grid = openFloor();
  put(grid, 1.0, -0.2, 1.2, 0.2, CellClass::kThreshold);
  put(grid, 2.0, -1.0, 2.4, 1.0, CellClass::kDropOff);
  look(map, grid, 3, {-1.3, 0.4, 2.5});
  MapCells cells;
  map.snapshot(cells);
  std::size_t known = 0;
  for (int iy = 0; iy < cells.size_y; ++iy) {
    for (int ix = 0; ix < cells.size_x; ++ix) {
      ASSERT_EQ(cells.at(ix, iy), at(map, cells.centreX(ix), cells.centreY(iy)));
      known += cells.at(ix, iy) != MapCell::kUnknown ? 1 : 0;
    }
  }
  EXPECT_GT(known, 2000U);
}

TEST(OccupancyMap, VersionChangesWithWhatIsJudgedOnly) {
  OccupancyMap map({});
  const FloorCells grid = openFloor();
  look(map, grid, 5);
  const std::uint32_t version = map.version();
  look(map, grid, 5);
  EXPECT_EQ(map.version(), version);
  FloorCells other = grid;
  put(other, 1.0, -0.2, 1.2, 0.2, CellClass::kThreshold);
  look(map, other, 5);
  EXPECT_NE(map.version(), version);
}

TEST(OccupancyMap, ListsEveryFaultOfItsParameters) {
  OccupancyParameters wrong;
  wrong.cell_size = std::nan("");
  wrong.hit = -1.0;
  const auto faults = validate(wrong);
  ASSERT_EQ(faults.size(), 2U);
  EXPECT_EQ(faults[0], "cell_size is nan, expected 0.01 to 0.5");
  EXPECT_EQ(faults[1], "hit is -1, expected 0.05 to 10");
  EXPECT_THROW(OccupancyMap map(wrong), std::invalid_argument);
  OccupancyParameters huge;
  huge.cell_size = 0.01;
  huge.max_side = 1000.0;
  EXPECT_FALSE(validate(huge).empty()) << "ten thousand million cells";
}

}  // namespace
}  // namespace pilothouse
