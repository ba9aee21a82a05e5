#include <gtest/gtest.h>

#include <algorithm>

#include "core/floor/nearest_objects.hpp"
#include "test/random_grid.hpp"

namespace pilothouse {
namespace {

FloorCells rowOf(std::vector<CellClass> classes, float x_min) {
  FloorCells grid;
  grid.geometry = {x_min, 0.0F, 0.1F, static_cast<int>(classes.size()), 1};
  grid.heights.assign(classes.size(), 0.0F);
  grid.classes = std::move(classes);
  return grid;
}

constexpr auto F = CellClass::kFloor, T = CellClass::kThreshold, O = CellClass::kObstacle,
               D = CellClass::kDropOff, U = CellClass::kUnknown;

TEST(NearestObjects, TheFirstObstacleOfARowIsNearestAndAllAreListed) {
  NearestObjects nearest;
  const auto objects = nearest.find(rowOf({F, U, O, O, F, O}, 0.2F));
  ASSERT_EQ(objects.size(), 3U);
  EXPECT_EQ(objects[0].ix, 2);
  EXPECT_TRUE(objects[0].nearest_in_row);
  EXPECT_FALSE(objects[1].nearest_in_row);
  EXPECT_FALSE(objects[2].nearest_in_row);
}

TEST(NearestObjects, AThresholdIsListedButDoesNotHideWhatComesAfter) {
  NearestObjects nearest;
  const auto objects = nearest.find(rowOf({F, T, T, D, O}, 0.2F));
  ASSERT_EQ(objects.size(), 4U);
  EXPECT_EQ(objects[0].kind, T);
  EXPECT_FALSE(objects[0].nearest_in_row);
  EXPECT_EQ(objects[2].kind, D);
  EXPECT_TRUE(objects[2].nearest_in_row);
  EXPECT_FALSE(objects[3].nearest_in_row);
}

TEST(NearestObjects, WalksForwardFromTheRobotNotFromTheGridsEdge) {
  NearestObjects nearest;
  const auto objects = nearest.find(rowOf({O, F, F, F, O, O}, -0.3F));  // the origin is in cell 3
  ASSERT_EQ(objects.size(), 3U);
  EXPECT_FALSE(objects[0].nearest_in_row) << "behind the robot";
  EXPECT_TRUE(objects[1].nearest_in_row);
}

TEST(NearestObjects, AnEmptyOrUnknownRowHasNone) {
  NearestObjects nearest;
  EXPECT_TRUE(nearest.find(rowOf({F, F, U, U}, 0.2F)).empty());
}

/// The nearest of a row by its definition: of all obstacle or drop-off cells that reach beyond x =
/// 0 the one of the smallest x; -1 without any.
int nearestByDefinition(const FloorCells& grid, int iy) {
  const GridGeometry& g = grid.geometry;
  int nearest = -1;
  for (int ix = g.size_x - 1; ix >= 0; --ix) {
    const CellClass c = grid.classes[g.index(ix, iy)];
    if (c != O && c != D) continue;
    const double far_edge = double{g.x_min} + (ix + 1) * double{g.cell_size};
    if (far_edge > 1e-6) nearest = ix;
  }
  return nearest;
}

TEST(NearestObjects, AgreesWithTheDefinitionOnRandomGrids) {
  std::mt19937 random(7);
  NearestObjects nearest;
  for (int trial = 0; trial < 500; ++trial) {
    const FloorCells grid = randomGrid(random);
    const GridGeometry& g = grid.geometry;
    const auto& objects = nearest.find(grid);
    std::vector<int> marked(static_cast<std::size_t>(g.size_y), -1);
    std::size_t next = 0;
    for (int iy = 0; iy < g.size_y; ++iy) {
      for (int ix = 0; ix < g.size_x; ++ix) {
        const CellClass c = grid.classes[g.index(ix, iy)];
        if (c == U || c == F) continue;
        ASSERT_LT(next, objects.size());
        const GridObject& object = objects[next++];
        ASSERT_EQ(object.ix, ix);
        ASSERT_EQ(object.iy, iy);
        ASSERT_EQ(object.kind, c);
        if (!object.nearest_in_row) continue;
        ASSERT_EQ(marked[static_cast<std::size_t>(iy)], -1) << "two nearest in a row";
        marked[static_cast<std::size_t>(iy)] = ix;
      }
      ASSERT_EQ(marked[static_cast<std::size_t>(iy)], nearestByDefinition(grid, iy))
          << "trial " << trial << " row " << iy << " x_min " << g.x_min << " cell " << g.cell_size;
    }
    ASSERT_EQ(next, objects.size());
  }
}

}  // namespace
}  // namespace pilothouse
