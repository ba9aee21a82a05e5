// What scans have met: what stands counts, what walked on or was taken away does not.
#include <gtest/gtest.h>

#include <cmath>

#include "core/pose/point_map.hpp"

namespace pilothouse {
namespace {

using Points = std::vector<Eigen::Vector2d>;

/// A wall across the way, seen from a base at x; what stands before it hides it.
Points wallFrom(double x, double wall, const Points& things = {}) {
  Points points;
  for (double bearing = -0.5; bearing <= 0.5; bearing += 0.01) {
    double range = (wall - x) / std::cos(bearing);
    for (const Eigen::Vector2d& thing : things) {
      const Eigen::Vector2d there = thing - Eigen::Vector2d(x, 0.0);
      const double off = std::atan2(there.y(), there.x()) - bearing;
      if (std::abs(off) * there.norm() < 0.15) range = std::min(range, there.norm());
    }
    points.emplace_back(range * std::cos(bearing), range * std::sin(bearing));
  }
  return points;
}

/// Of those that count, how many are within 0.3 m of a place.
std::size_t near(const PointMap& map, const Eigen::Vector2d& place) {
  std::size_t count = 0;
  for (const MapPoint& point : map.points()) {
    if ((point.position - place).norm() < 0.3) ++count;
  }
  return count;
}

const Eigen::Vector2d kThing(2.0, 0.3), kBehind(4.0, 0.6);

TEST(PointMap, CountsWhatSeveralScansMetAndFromTheFirstOneAll) {
  PointMap map({});
  map.add(wallFrom(0.0, 4.0), {});
  EXPECT_GT(near(map, kBehind), 5U) << "there is nothing else to go by";
  map.add(wallFrom(0.25, 4.0, {kThing}), {0.25, 0.0, 0.0});
  EXPECT_EQ(near(map, kThing), 0U) << "it may walk on";
  map.add(wallFrom(0.5, 4.0, {kThing}), {0.5, 0.0, 0.0});
  EXPECT_GT(near(map, kThing), 2U);
}

TEST(PointMap, NeverCountsWhatWalks) {
  PointMap map({});
  map.add(wallFrom(0.0, 4.0), {});
  for (int i = 1; i <= 12; ++i) {
    const double x = 0.1 * i, y = 0.25 * i - 1.5;
    map.add(wallFrom(x, 4.0, {{2.5, y}}), {x, 0.0, 0.0});
    for (const MapPoint& point : map.points()) {
      ASSERT_NEAR(point.position.x(), 4.0, 0.1) << "after scan " << i;
    }
  }
}

TEST(PointMap, ForgetsWhatIsSeenThrough) {
  PointMap map({});
  for (int i = 0; i < 4; ++i) map.add(wallFrom(0.0, 4.0, {kThing}), {});
  ASSERT_GT(near(map, kThing), 2U);
  for (int i = 0; i < 4; ++i) map.add(wallFrom(0.0, 4.0), {});
  EXPECT_EQ(near(map, kThing), 0U);
  EXPECT_GT(near(map, kBehind), 5U) << "which is seen now";
}

TEST(PointMap, KeepsWhatIsHiddenOrWhereNothingComesBack) {
  PointMap map({});
  for (int i = 0; i < 3; ++i) map.add(wallFrom(0.0, 4.0, {kThing}), {});
  const std::size_t thing = near(map, kThing), wall = near(map, {4.0, -0.6});
  ASSERT_GT(thing, 2U);
  ASSERT_GT(wall, 5U);
  for (int i = 0; i < 20; ++i) map.add(wallFrom(0.0, 1.0), {});
  EXPECT_EQ(near(map, kThing), thing) << "somebody stands before it";
  Points nothing;
  for (const Eigen::Vector2d& point : wallFrom(0.0, 4.0)) {
    if (point.y() < -0.3) nothing.push_back(point);
  }
  for (int i = 0; i < 20; ++i) map.add(nothing, {});
  EXPECT_EQ(near(map, kThing), thing) << "no beam came back from there";
  EXPECT_GE(near(map, {4.0, -0.6}), wall);
}

TEST(PointMap, LooksFromWhereTheSensorSits) {
  // The sensor sits 1 m beside the base and sees past the thing to the wall.
  PointMap map({});
  const Pose2 base{0.0, 0.0, 0.0};
  for (int i = 0; i < 3; ++i) map.add(wallFrom(0.0, 4.0, {kThing}), base);
  const std::size_t before = near(map, kThing);
  ASSERT_GT(before, 2U);
  Points beside = wallFrom(0.0, 4.0);
  for (Eigen::Vector2d& point : beside) point.y() += 2.0;
  for (int i = 0; i < 20; ++i) map.add(beside, base, {0.0, 2.0});
  EXPECT_EQ(near(map, kThing), before);
}

}  // namespace
}  // namespace pilothouse
