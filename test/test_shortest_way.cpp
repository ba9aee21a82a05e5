// The optimum that the planner is judged by, against lengths worked out by hand.
#include "bench/shortest_way.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "bench/world_map.hpp"
#include "sim/furniture.hpp"

namespace pilothouse::bench {
namespace {

using Eigen::Vector2d;

ConvexShape box(double x0, double y0, double x1, double y1) {
  return ConvexShape({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}});
}

TEST(ConvexShape, TellsDistancesOfPointsAndSegments) {
  const ConvexShape shape({{0.0, 0.0}, {1.0, 0.0}, {0.5, 0.2}, {1.0, 1.0}, {0.0, 1.0}});
  EXPECT_EQ(shape.corners().size(), 4U) << "the one within is no corner";
  EXPECT_DOUBLE_EQ(shape.distanceTo({2.0, 0.5}), 1.0);
  EXPECT_DOUBLE_EQ(shape.distanceTo({4.0, 5.0}), 5.0);
  EXPECT_EQ(shape.distanceTo({0.4, 0.4}), 0.0);
  EXPECT_EQ(shape.distanceTo({-1.0, 0.5}, {2.0, 0.5}), 0.0) << "right through";
  EXPECT_NEAR(shape.distanceTo({0.0, 2.0}, {2.0, 0.5}), 0.2, 1e-9) << "past the corner (1, 1)";
}

TEST(ShortestWay, IsStraightWhereNothingStands) {
  EXPECT_DOUBLE_EQ(shortestWay({box(2.0, 2.0, 3.0, 3.0)}, 0.3, {0.0, 0.0}, {4.0, 1.0}),
                   std::hypot(4.0, 1.0));
}

TEST(ShortestWay, RoundABoxIsTangentsAndArcs) {
  // From 2 m before a box, in its middle, to 2 m behind it: to each near corner a tangent, round it
  // an arc, and along the side.
  const double r = 0.3, half = 0.5;
  const double length = shortestWay({box(-half, -half, half, half)}, r, {-2.5, 0.0}, {2.5, 0.0});
  const double off = std::hypot(2.0, half);
  const double tangent = std::sqrt(off * off - r * r);
  const double up = std::atan2(half, 2.0) + std::asin(r / off);
  const double best = 2.0 * tangent + 2.0 * r * up + 2.0 * half;
  EXPECT_LE(length, best * (1.0 + 1e-9)) << "never more than the optimum";
  EXPECT_GE(length, 0.997 * best);
}

TEST(ShortestWay, TakesTheGapThatIsWideEnough) {
  // A wall with a gap of 0.5 m straight ahead and one of 1 m aside.
  const std::vector<ConvexShape> walls = {box(0.0, -9.0, 0.1, -0.25), box(0.0, 0.25, 0.1, 2.0),
                                          box(0.0, 3.0, 0.1, 9.0)};
  EXPECT_DOUBLE_EQ(shortestWay(walls, 0.24, {-1.0, 0.0}, {1.0, 0.0}), 2.0);
  EXPECT_GT(shortestWay(walls, 0.3, {-1.0, 0.0}, {1.0, 0.0}), 4.0);
  EXPECT_LT(shortestWay(walls, 0.3, {-1.0, 0.0}, {1.0, 0.0}), 6.0);
}

TEST(ShortestWay, IsInfiniteWhereThereIsNone) {
  const std::vector<ConvexShape> ring = {box(-1.0, -1.0, 1.0, -0.9), box(-1.0, 0.9, 1.0, 1.0),
                                         box(-1.0, -1.0, -0.9, 1.0), box(0.9, -1.0, 1.0, 1.0)};
  EXPECT_TRUE(std::isinf(shortestWay(ring, 0.1, {0.0, 0.0}, {3.0, 0.0})));
  EXPECT_TRUE(std::isinf(shortestWay(ring, 0.1, {3.0, 0.0}, {0.95, 0.0})));
  EXPECT_TRUE(std::isfinite(shortestWay(ring, 0.1, {0.0, 0.0}, {0.5, 0.5})));
}

TEST(DiscReach, GoesThroughWhatIsWiderThanTheDisc) {
  const std::vector<ConvexShape> walls = {box(0.0, -3.0, 0.1, -0.4), box(0.0, 0.4, 0.1, 3.0),
                                          box(-3.0, -3.0, 3.0, -2.9), box(-3.0, 2.9, 3.0, 3.0)};
  const DiscReach fits(walls, 0.35, {-1.0, 0.2});
  EXPECT_TRUE(fits.reaches({-1.0, -2.0}));
  EXPECT_TRUE(fits.reaches({1.0, 1.0}));
  EXPECT_FALSE(fits.reaches({1.0, 2.8})) << "too near to the wall";
  EXPECT_FALSE(fits.reaches({1.0, 5.0})) << "beyond all that stands there";
  const DiscReach large(walls, 0.45, {-1.0, 0.2});
  EXPECT_TRUE(large.reaches({-1.0, -2.0}));
  EXPECT_FALSE(large.reaches({1.0, 1.0}));
}

TEST(ShapesOf, TakesWhatStandsInTheRobotsHeight) {
  sim::World world;
  sim::Finishes finishes(world.textures);
  sim::Model table = sim::modelAt("table", {1.0, 2.0, 0.0});
  sim::addTable(table, finishes, {1.0, 0.6, 0.7});
  world.models.push_back(table);
  const auto all = [](const sim::Model&) { return true; };
  // Below the top only the legs; a robot as high as the top meets that.
  EXPECT_EQ(shapesOf(world, 0.4, all).size(), 4U);
  const auto high = shapesOf(world, 0.75, all);
  ASSERT_EQ(high.size(), 5U);
  double widest = 0.0;
  for (const auto& shape : high) widest = std::max(widest, shape.bounds().sizes().x());
  EXPECT_NEAR(widest, 1.0, 1e-5);
  EXPECT_TRUE(shapesOf(world, 0.4, [](const sim::Model&) { return false; }).empty());
}

}  // namespace
}  // namespace pilothouse::bench
