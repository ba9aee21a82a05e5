#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/motion/route.hpp"
#include "sim/random.hpp"

namespace pilothouse {
namespace {

using Eigen::Vector2d;
using Points = std::vector<Vector2d>;

Points randomPoints(sim::Random& random, int count, double size) {
  Points points;
  for (int i = 0; i < count; ++i) {
    points.emplace_back(random.uniform(-size, size), random.uniform(-size, size));
  }
  return points;
}

/// Least distance of the point from the way, found by walking it.
double gap(const Route& route, const Vector2d& point, double from, double to) {
  double least = std::numeric_limits<double>::infinity();
  for (double way = from; way <= to; way += 0.01) {
    least = std::min(least, (route.at(way).position - point).norm());
  }
  return least;
}

double distanceToLeg(const Vector2d& p, const Vector2d& a, const Vector2d& b) {
  const Vector2d leg = b - a;
  const double share = std::clamp(leg.dot(p - a) / leg.squaredNorm(), 0.0, 1.0);
  return (p - a - share * leg).norm();
}

TEST(Route, AStraightLegIsAsLongAsItIs) {
  const Route route({{0, 0}, {3, 4}}, {});
  EXPECT_DOUBLE_EQ(route.length(), 5.0);
  EXPECT_NEAR((route.at(2.5).position - Vector2d(1.5, 2.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((route.at(9.0).position - Vector2d(3.0, 4.0)).norm(), 0.0, 1e-12);
  EXPECT_DOUBLE_EQ(route.stopAfter(0.0), 5.0);
}

TEST(Route, ACornerIsRoundedAsWidelyAsTheCutAllows) {
  const Route route({{0, 0}, {2, 0}, {2, 2}}, {0.5, 0.1});
  const double radius = 0.1 / (std::sqrt(2.0) - 1.0);
  EXPECT_NEAR(route.at(1.0 + 1.0 - radius + 0.1).curvature, 1.0 / radius, 1e-9);
  EXPECT_NEAR(gap(route, {2, 0}, 0.0, route.length()), 0.1, 1e-3);
  EXPECT_DOUBLE_EQ(route.stopAfter(0.0), route.length()) << "no stop at a rounded corner";
}

TEST(Route, ATurnBackStaysSharp) {
  const Route route({{0, 0}, {2, 0}, {0, 0}}, {0.5, 0.1});
  EXPECT_DOUBLE_EQ(route.stopAfter(0.0), 2.0);
  EXPECT_DOUBLE_EQ(route.stopAfter(2.0 + 1e-5), 4.0);
  EXPECT_DOUBLE_EQ(route.length(), 4.0);
  EXPECT_EQ(route.target(1.0), 1U);
  EXPECT_EQ(route.target(3.0), 2U);
}

TEST(Route, PointsAtOnePlaceAreOne) {
  EXPECT_TRUE(Route({}, {}).empty());
  EXPECT_TRUE(Route({{1, 1}}, {}).empty());
  EXPECT_TRUE(Route({{1, 1}, {1, 1}}, {}).empty());
  const Route route({{0, 0}, {0, 0}, {1, 0}, {1, 0}, {1, 1}}, {});
  EXPECT_EQ(route.target(0.1), 2U);
}

TEST(Route, EveryPointIsPassedWithinTheCutAndTheWayLeavesTheLegsNoFarther) {
  sim::Random random(3);
  for (int run = 0; run < 200; ++run) {
    const Points points = randomPoints(random, random.integer(2, 8), 3.0);
    const CornerParameters corners{random.uniform(0.0, 1.5), random.uniform(0.0, 0.3)};
    const Route route(points, corners);
    for (const auto& point : points) {
      ASSERT_LE(gap(route, point, 0.0, route.length() + 0.01), corners.max_cut + 0.011);
    }
    Vector2d before = points.front();
    for (double way = 0.0; way <= route.length(); way += 0.01) {
      const Route::Place place = route.at(way);
      double off = std::numeric_limits<double>::infinity();
      for (std::size_t i = 1; i < points.size(); ++i) {
        off = std::min(off, distanceToLeg(place.position, points[i - 1], points[i]));
      }
      ASSERT_LE(off, corners.max_cut + 1e-6);
      ASSERT_LE((place.position - before).norm(), 0.01 + 1e-6) << "the way is whole";
      ASSERT_NEAR(place.direction.norm(), 1.0, 1e-9);
      before = place.position;
    }
    EXPECT_NEAR((before - points.back()).norm(), 0.0, 0.011);
  }
}

TEST(Route, TheFootOfAPointIsTheNearestPlaceOfTheStretch) {
  sim::Random random(4);
  for (int run = 0; run < 200; ++run) {
    const bool loop = random.chance(0.5);
    const Route route(randomPoints(random, random.integer(3, 7), 2.0), {0.6, 0.2},
                      loop ? 1 : Route::kNoLoop);
    const Vector2d point(random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0));
    const double from = random.uniform(0.0, route.length() * (loop ? 3.0 : 1.0));
    const double to = from + random.uniform(0.0, 5.0);
    const Route::Foot foot = route.nearest(point, from, to);
    ASSERT_GE(foot.way, from - 1e-9);
    ASSERT_LE(foot.way, to + 1e-9);
    ASSERT_NEAR((route.at(foot.way).position - point).norm(), foot.distance, 1e-6);
    ASSERT_LE(foot.distance, gap(route, point, from, to) + 1e-9);
  }
}

TEST(Route, ALoopGoesRoundWithoutAGap) {
  sim::Random random(5);
  for (int run = 0; run < 100; ++run) {
    const Points points = randomPoints(random, random.integer(3, 7), 2.0);
    const Route route(points, {0.4, 0.1}, 1);
    ASSERT_TRUE(route.loop());
    Vector2d before = route.at(0.0).position;
    for (double way = 0.0; way < route.length() + 2.2 * route.round(); way += 0.01) {
      const Vector2d here = route.at(way).position;
      ASSERT_LE((here - before).norm(), 0.0101) << "at " << way << " of " << route.length();
      before = here;
    }
    for (std::size_t i = 1; i < points.size(); ++i) {
      ASSERT_LE(gap(route, points[i], route.length(), route.length() + route.round()), 0.111);
    }
  }
}

TEST(Route, BendsAreAnnouncedWhereTheyBegin) {
  const Route route({{0, 0}, {2, 0}, {2, 2}, {4, 2}}, {0.5, 10.0});
  std::vector<double> begins;
  route.curvatures(0.0, 10.0, [&](double begin, double curvature) {
    if (curvature > 0.0) {
      begins.push_back(begin);
      EXPECT_NEAR(curvature, 2.0, 1e-9);
    }
  });
  ASSERT_EQ(begins.size(), 2U);
  EXPECT_NEAR(begins[0], 1.5, 1e-9);
  EXPECT_NEAR(begins[1], 1.5 + 0.5 * 1.5707963 + 1.0, 1e-6);
}

}  // namespace
}  // namespace pilothouse
