#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/motion/range_objects.hpp"
#include "sim/random.hpp"

namespace pilothouse {
namespace {

constexpr double kPi = 3.141592653589793;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Eigen::Isometry3d at(double x, double y, double yaw, double pitch = 0.0) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translate(Eigen::Vector3d(x, y, 0.2));
  T.rotate(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
  T.rotate(Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()));
  return T;
}

RangeReading echo(double range) {
  return {range, 0.5, 0.03, 3.0};
}

/// How far the place is from the nearest disc's rim; negative within one.
double gapTo(const std::vector<Obstacle>& objects, const Eigen::Vector2d& place) {
  double least = kInfinity;
  for (const auto& object : objects) {
    least = std::min(least, (object.position.cast<double>() - place).norm() - 0.5 * object.size);
  }
  return least;
}

TEST(RangeObjects, AnEchoAheadLiesAheadAtItsRange) {
  std::vector<Obstacle> objects;
  ASSERT_TRUE(objectsOf(echo(1.0), at(0.25, 0.0, 0.0), 0.05, objects));
  ASSERT_FALSE(objects.empty());
  EXPECT_LT(gapTo(objects, {1.25, 0.0}), 0.0);
  for (const auto& object : objects) {
    EXPECT_NEAR((object.position.cast<double>() - Eigen::Vector2d(0.25, 0.0)).norm(), 1.0, 1e-5);
    EXPECT_EQ(object.kind, CellClass::kObstacle);
    EXPECT_TRUE(std::isnan(object.height));
    EXPECT_FALSE(object.remembered);
  }
}

TEST(RangeObjects, ARearRangerSeesBehind) {
  std::vector<Obstacle> objects;
  ASSERT_TRUE(objectsOf(echo(0.5), at(-0.25, 0.0, kPi), 0.05, objects));
  EXPECT_LT(gapTo(objects, {-0.75, 0.0}), 0.0);
  EXPECT_GT(gapTo(objects, {0.25, 0.0}), 0.5);
}

TEST(RangeObjects, OfATiltedRangerTheLevelDistanceCounts) {
  std::vector<Obstacle> objects;
  ASSERT_TRUE(objectsOf({1.0, 0.02, 0.0, 3.0}, at(0.0, 0.0, 0.0, kPi / 3.0), 0.05, objects));
  EXPECT_LT(gapTo(objects, {0.5, 0.0}), 0.0);
}

TEST(RangeObjects, NothingWithinReachIsNoObject) {
  std::vector<Obstacle> objects(3);
  EXPECT_TRUE(objectsOf(echo(kInfinity), at(0, 0, 0), 0.05, objects));
  EXPECT_TRUE(objects.empty());
  EXPECT_TRUE(objectsOf(echo(3.0), at(0, 0, 0), 0.05, objects));
  EXPECT_TRUE(objects.empty());
}

TEST(RangeObjects, TooNearToMeasureIsAnObjectAtTheLeastRange) {
  std::vector<Obstacle> objects;
  for (const double range : {0.01, 0.0, -1.0, -kInfinity}) {
    ASSERT_TRUE(objectsOf(echo(range), at(0, 0, 0), 0.05, objects)) << range;
    EXPECT_LT(gapTo(objects, {0.03, 0.0}), 0.0) << range;
  }
}

TEST(RangeObjects, AReadingThatMeansNothingIsRefused) {
  std::vector<Obstacle> objects(3);
  Eigen::Isometry3d nowhere = at(0, 0, 0);
  nowhere.translation().x() = kNan;
  EXPECT_FALSE(objectsOf(echo(1.0), nowhere, 0.05, objects));
  for (const RangeReading& bad : {RangeReading{kNan, 0.5, 0.03, 3.0},
                                  {1.0, kNan, 0.03, 3.0},
                                  {1.0, 0.0, 0.03, 3.0},
                                  {1.0, -0.1, 0.03, 3.0},
                                  {1.0, 3.2, 0.03, 3.0},
                                  {1.0, 1e30, 0.03, 3.0},
                                  {1.0, kInfinity, 0.03, 3.0},
                                  {1.0, 0.5, -0.1, 3.0},
                                  {1.0, 0.5, kNan, 3.0},
                                  {1.0, 0.5, 0.03, kNan},
                                  {1.0, 0.5, 0.03, kInfinity},
                                  {1.0, 0.5, 3.0, 3.0}}) {
    EXPECT_FALSE(objectsOf(bad, at(0, 0, 0), 0.05, objects));
    EXPECT_TRUE(objects.empty());
  }
}

TEST(RangeObjects, EveryPlaceOnTheArcIsCoveredByFewOverlappingDiscs) {
  sim::Random random(1);
  std::vector<Obstacle> objects;
  for (int i = 0; i < 300; ++i) {
    const double largest = random.uniform(0.1, 2000.0);
    const RangeReading reading{random.uniform(0.0, largest), random.uniform(1e-6, kPi), 0.0,
                               largest};
    const double piece = random.uniform(0.001, 0.3);
    const double yaw = random.uniform(-kPi, kPi);
    ASSERT_TRUE(objectsOf(reading, at(0.2, -0.1, yaw), piece, objects));
    ASSERT_LE(objects.size(), 256U);
    ASSERT_GE(objects.size(), 1U);
    for (int step = 0; step <= 100; ++step) {
      const double angle = yaw + reading.field_of_view * (0.01 * step - 0.5);
      const Eigen::Vector2d place(0.2 + reading.range * std::cos(angle),
                                  -0.1 + reading.range * std::sin(angle));
      ASSERT_LE(gapTo(objects, place), 1e-5 * (1.0 + reading.range))
          << "range " << reading.range << " of view " << reading.field_of_view;
    }
    if (reading.range * reading.field_of_view < 100.0 * piece) {
      EXPECT_NEAR(objects.front().size, piece, 1e-5);
    }
  }
}

}  // namespace
}  // namespace pilothouse
