#include <gtest/gtest.h>

#include <cmath>

#include "core/floor/floor_patches.hpp"
#include "core/floor/floor_surface.hpp"
#include "core/floor/near_floor.hpp"
#include "core/floor/raised_part.hpp"

namespace pilothouse {
namespace {

GridGeometry geometry() {
  return {0.2F, -1.0F, 0.05F, 60, 40};
}

/// A grid whose known cells have the heights of f(x, y).
template <class Height>
FloorCells gridOf(Height f) {
  FloorCells grid;
  grid.geometry = geometry();
  const std::size_t cells = grid.geometry.cells();
  grid.classes.assign(cells, CellClass::kFloor);
  grid.deviations.assign(cells, 0.0F);
  grid.counts.assign(cells, 10);
  for (int iy = 0; iy < grid.geometry.size_y; ++iy) {
    for (int ix = 0; ix < grid.geometry.size_x; ++ix) {
      grid.heights.push_back(f(grid.geometry.centreX(ix), grid.geometry.centreY(iy)));
    }
  }
  return grid;
}

TEST(FloorSurface, ContinuesATiltedFloorOverAHole) {
  const FloorCells grid = gridOf([](float x, float y) { return 0.01F + 0.1F * x - 0.05F * y; });
  std::vector<std::uint8_t> is_floor(grid.classes.size(), 1);
  for (int iy = 10; iy < 20; ++iy) {
    for (int ix = 20; ix < 30; ++ix) is_floor[grid.geometry.index(ix, iy)] = 0;
  }
  FloorSurface surface;
  surface.configure(grid.geometry);
  surface.fit(is_floor, grid.heights);
  EXPECT_NEAR(surface.expected(25, 15), grid.heights[grid.geometry.index(25, 15)], 1e-3);
  EXPECT_NEAR(surface.whole().slope_x, 0.1, 1e-3);
}

TEST(FloorSurface, FollowsTheFloorRoundThePlaceNotTheWhole) {
  // Level, then a ramp of 10 degrees.
  const auto height = [](float x, float) { return x < 1.5F ? 0.0F : 0.176F * (x - 1.5F); };
  const FloorCells grid = gridOf(height);
  FloorSurface surface;
  surface.configure(grid.geometry);
  surface.fit(std::vector<std::uint8_t>(grid.classes.size(), 1), grid.heights);
  EXPECT_NEAR(surface.expected(5, 20), 0.0, 1e-3);
  EXPECT_NEAR(surface.expected(55, 20), height(grid.geometry.centreX(55), 0.0F), 2e-3);
}

TEST(FloorSurface, CellsAddedLaterCountLikeThoseOfTheFirstFit) {
  const FloorCells grid = gridOf([](float x, float y) { return 0.02F * x * x + 0.01F * y; });
  FloorSurface whole, grown;
  whole.configure(grid.geometry);
  grown.configure(grid.geometry);
  std::vector<std::uint8_t> is_floor(grid.classes.size(), 1);
  whole.fit(is_floor, grid.heights);
  std::vector<std::uint32_t> later;
  for (std::uint32_t i = 0; i < is_floor.size(); i += 3) {
    is_floor[i] = 0;
    later.push_back(i);
  }
  grown.fit(is_floor, grid.heights);
  grown.add(later.data(), later.size(), grid.heights);
  grown.refit();
  for (int ix = 0; ix < 60; ix += 7) {
    EXPECT_NEAR(grown.expected(ix, 12), whole.expected(ix, 12), 1e-5);
  }
}

TEST(FloorSurface, WithoutFloorIsLevelWithTheRobot) {
  FloorSurface surface;
  surface.configure(geometry());
  surface.fit(std::vector<std::uint8_t>(geometry().cells(), 0),
              std::vector<float>(geometry().cells(), std::nanf("")));
  EXPECT_EQ(surface.expected(30, 20), 0.0F);
}

TEST(FloorPatches, AStepLargerThanAllowedParts) {
  const FloorCells grid = gridOf([](float x, float) { return x < 1.5F ? 0.0F : 0.03F; });
  FloorPatches patches;
  patches.configure(grid.geometry);
  const std::vector<std::uint8_t> even(grid.classes.size(), 1);
  patches.find(grid, even, 0.025F);
  ASSERT_EQ(patches.patches().size(), 2U);
  EXPECT_EQ(patches.patches()[0].size + patches.patches()[1].size, grid.classes.size());
  EXPECT_EQ(patches.patches()[0].points, 10U * patches.patches()[0].size);
  patches.find(grid, even, 0.035F);
  EXPECT_EQ(patches.patches().size(), 1U);
}

TEST(FloorPatches, CellsThatAreNotEvenBelongToNone) {
  const FloorCells grid = gridOf([](float, float) { return 0.0F; });
  std::vector<std::uint8_t> even(grid.classes.size(), 1);
  for (int iy = 0; iy < grid.geometry.size_y; ++iy) even[grid.geometry.index(30, iy)] = 0;
  FloorPatches patches;
  patches.configure(grid.geometry);
  patches.find(grid, even, 0.025F);
  EXPECT_EQ(patches.patches().size(), 2U);
  EXPECT_EQ(patches.patchOf()[grid.geometry.index(30, 3)], -1);
  EXPECT_NE(patches.patchOf()[grid.geometry.index(29, 3)],
            patches.patchOf()[grid.geometry.index(31, 3)]);
}

TEST(RaisedPart, FindsHowManyPointsAreHowHigh) {
  // 5 of 200 points 7 cm up: mean and variance by hand.
  const float mean = 5.0F / 200.0F * 0.07F;
  const float variance = mean * (0.07F - mean);
  const RaisedPart part = raisedPart(200, mean, variance, 0.0F);
  EXPECT_NEAR(part.points, 5.0F, 1e-3);
  EXPECT_NEAR(part.height, 0.07F, 1e-5);
  const RaisedPart sunk = raisedPart(200, -mean, variance, 0.0F);
  EXPECT_NEAR(sunk.points, 5.0F, 1e-3);
  EXPECT_NEAR(sunk.height, -0.07F, 1e-5);
}

TEST(NearFloor, IsThePlaneAtTheRobotNotTheRampBeyond) {
  const FloorCells grid = gridOf([](float x, float y) {
    const float floor = 0.004F + 0.03F * x - 0.01F * y;
    return x < 0.9F ? floor : floor + 0.12F * (x - 0.9F);
  });
  NearFloor near;
  near.configure(grid.geometry);
  const auto plane = near.fit(std::vector<std::uint8_t>(grid.classes.size(), 1), grid);
  ASSERT_TRUE(plane);
  EXPECT_NEAR(plane->slope_x, 0.03, 0.001);
  EXPECT_NEAR(plane->slope_y, -0.01, 0.001);
  EXPECT_NEAR(plane->height, 0.004, 0.001);
}

TEST(NearFloor, ASillRightBeforeTheRobotDoesNotTiltIt) {
  for (const float begin : {0.2F, 0.35F, 0.5F, 0.7F}) {
    const FloorCells grid = gridOf([&](float x, float y) {
      const float floor = 0.005F - 0.02F * x + 0.01F * y;
      return x > begin && x < begin + 0.15F ? floor + 0.02F : floor;
    });
    NearFloor near;
    near.configure(grid.geometry);
    const auto plane = near.fit(std::vector<std::uint8_t>(grid.classes.size(), 1), grid);
    ASSERT_TRUE(plane);
    EXPECT_NEAR(plane->slope_x, -0.02, 1e-3) << begin;
    EXPECT_NEAR(plane->at(0.6, 0.0), 0.005 - 0.02 * 0.6, 1e-3) << begin;
  }
}

TEST(NearFloor, NeedsSomeFloor) {
  const FloorCells grid = gridOf([](float, float) { return 0.0F; });
  std::vector<std::uint8_t> is_floor(grid.classes.size(), 0);
  for (std::size_t i = 0; i < 20; ++i) is_floor[i] = 1;
  NearFloor near;
  near.configure(grid.geometry);
  EXPECT_FALSE(near.fit(is_floor, grid));
  EXPECT_FALSE(near.fit(std::vector<std::uint8_t>(grid.classes.size(), 0), grid));
}

}  // namespace
}  // namespace pilothouse
