// The swept path against driving it in small steps, and the original's corridor by its own figures.

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <vector>

#include "core/motion/swept_path.hpp"
#include "sim/random.hpp"

namespace pilothouse {
namespace {

using Eigen::Vector2d;

const Footprint& platform() {
  static const Footprint outline({{0.25, 0.20}, {-0.25, 0.20}, {-0.25, -0.20}, {0.25, -0.20}});
  return outline;
}

Footprint round(double radius) {
  std::vector<Vector2d> corners;
  for (int i = 0; i < 16; ++i) {
    corners.emplace_back(radius * std::cos(i * M_PI / 8), radius * std::sin(i * M_PI / 8));
  }
  return Footprint(corners);
}

/// Way of the touching point until the outline, driven in small steps, is within `radius` of p.
std::optional<double> driven(const Footprint& outline, const Twist2& twist, const Vector2d& p,
                             double radius, double look_ahead, double turn) {
  constexpr double kStep = 0.002;
  const SweptPath path(outline, twist, 0.0, look_ahead);
  const double speed = SweptPath::speedOf(outline, twist);
  const double w = twist.w / speed;
  const Vector2d centre =
      std::abs(w) > 1e-6 ? Vector2d(Vector2d(-twist.vy, twist.vx) / twist.w) : Vector2d(0.0, 0.0);
  for (double way = 0.0; way < look_ahead && std::abs(w) * way < turn; way += kStep) {
    if (outline.distanceTo(path.poseAfter(way).toBase(p)) > radius) continue;
    return std::abs(w) > 1e-6 ? way * std::abs(w) * (p - centre).norm() : way;
  }
  return std::nullopt;
}

void compare(const Footprint& outline, std::uint64_t seed, double w_share) {
  sim::Random random(seed);
  int touched = 0;
  for (int i = 0; i < 400; ++i) {
    const double angle = random.uniform(-M_PI, M_PI);
    const double w = w_share * random.uniform(-4.0, 4.0);
    const Twist2 twist{std::cos(angle) * (w_share > 2.0 ? 0.02 : 1.0), std::sin(angle) * 0.5, w};
    const Vector2d p(random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5));
    const double radius = random.uniform(0.005, 0.05);
    if (outline.distanceTo(p) < radius + 0.08) continue;  // corners are mitred, not rounded
    const SweptPath path(outline, twist, 0.0, 3.0);
    const auto contact = path.meet(p, radius);
    const auto expected = driven(outline, twist, p, radius, 2.9, 1.17);
    if (expected) {
      ++touched;
      EXPECT_EQ(contact.relevance, Relevance::kInTheWay) << "seed " << seed << ", case " << i;
      EXPECT_LE(contact.distance, *expected + 0.005) << "seed " << seed << ", case " << i;
    }
    const auto grown = driven(outline, twist, p, radius * 1.5 + 0.005, 3.1, 1.25);
    if (contact.relevance == Relevance::kInTheWay) {
      ASSERT_TRUE(grown.has_value()) << "seed " << seed << ", case " << i;
      EXPECT_GE(contact.distance, *grown - 0.02 - 0.1 * *grown)
          << "seed " << seed << ", case " << i;
    }
  }
  EXPECT_GT(touched, 5);
}

TEST(SweptPath, AgreesWithDrivingInSmallSteps) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    compare(platform(), seed, 0.0);
    compare(platform(), seed, 0.4);
    compare(platform(), seed, 1.0);
    compare(round(0.177), seed, 1.0);
  }
}

TEST(SweptPath, TurningInPlaceOnlyMeetsWhatTheCornersReach) {
  const SweptPath path(platform(), {0.0, 0.0, 1.0}, 0.2, 3.0);
  const double reach = std::hypot(0.25, 0.20);
  EXPECT_EQ(path.meet({0.0, 0.27}, 0.0).relevance, Relevance::kInTheWay);
  EXPECT_EQ(path.meet({0.0, reach + 0.02}, 0.0).relevance, Relevance::kPotential);
  EXPECT_EQ(path.meet({0.0, reach + 0.05}, 0.0).relevance, Relevance::kOther)
      << "turning in place goes past nothing";
  // Counter-clockwise, the corner at front right comes to a point right ahead.
  const auto contact = path.meet({0.30, 0.0}, 0.0);
  // It touches where the front edge, x = 0.25, has turned to it.
  EXPECT_NEAR(contact.distance, 0.30 * std::acos(0.25 / 0.30), 1e-9);
}

TEST(SweptPath, GoingAwayFromWhatIsTouchedIsFree) {
  const SweptPath ahead(platform(), {1.0, 0.0, 0.0}, 0.2, 3.0);
  const SweptPath back(platform(), {-1.0, 0.0, 0.0}, 0.2, 3.0);
  const Vector2d touched(0.24, 0.0);
  EXPECT_EQ(ahead.meet(touched, 0.02).relevance, Relevance::kInTheWay);
  EXPECT_EQ(ahead.meet(touched, 0.02).distance, 0.0);
  EXPECT_NE(back.meet(touched, 0.02).relevance, Relevance::kInTheWay);
}

TEST(SweptPath, StandingMeetsNothing) {
  const SweptPath path(platform(), {}, 0.2, 3.0);
  EXPECT_EQ(path.meet({0.3, 0.0}, 0.05).relevance, Relevance::kOther);
}

TEST(SweptPath, WhatIsBesideIsPotentialWithinTheMargin) {
  const SweptPath path(platform(), {1.0, 0.0, 0.0}, 0.15, 3.0);
  EXPECT_EQ(path.meet({1.0, 0.19}, 0.0).relevance, Relevance::kInTheWay);
  EXPECT_NEAR(path.meet({1.0, 0.19}, 0.0).distance, 0.75, 1e-9);
  EXPECT_EQ(path.meet({1.0, 0.34}, 0.0).relevance, Relevance::kPotential);
  EXPECT_NEAR(path.meet({1.0, 0.34}, 0.0).distance, 0.75, 1e-9);
  EXPECT_EQ(path.meet({0.0, 0.34}, 0.0).distance, 0.0) << "beside it now";
  EXPECT_EQ(path.meet({1.0, 0.36}, 0.0).relevance, Relevance::kOther);
  EXPECT_EQ(path.meet({-0.3, 0.30}, 0.0).relevance, Relevance::kOther) << "behind";
}

// The original's formula: moving sideways, a long robot sweeps more.
TEST(Corridor, IsAsWideAsTheFarthestCorner) {
  EXPECT_NEAR(Corridor(platform(), {1.0, 0.0}, 0.0).halfWidth(), 0.20, 1e-12);
  EXPECT_NEAR(Corridor(platform(), {0.0, 2.0}, 0.0).halfWidth(), 0.25, 1e-12);
  EXPECT_NEAR(Corridor(platform(), {1.0, 1.0}, 0.0).halfWidth(), (0.25 + 0.20) / std::sqrt(2.0),
              1e-12);
}

TEST(Corridor, SortsWhatLiesInBesideAndBehind) {
  const Corridor corridor(platform(), {1.0, 1.0}, 0.1);
  EXPECT_EQ(corridor.classify({1.0, 1.0}, 0.0), Relevance::kInTheWay);
  EXPECT_EQ(corridor.classify({-1.0, -1.0}, 0.0), Relevance::kOther) << "behind";
  const Vector2d beside = Vector2d(1.0, 1.0) + 0.37 * Vector2d(-1.0, 1.0).normalized();
  EXPECT_EQ(corridor.classify(beside, 0.0), Relevance::kPotential);
  EXPECT_EQ(corridor.classify(beside, 0.06), Relevance::kInTheWay);
  EXPECT_EQ(corridor.classify(Vector2d(1.0, -0.2), 0.0), Relevance::kOther);
}

// Straight ahead, swept area and corridor say the same of everything that is before the robot.
TEST(Corridor, AgreesWithTheSweptPathAheadOfASymmetricRobot) {
  sim::Random random(7);
  for (int i = 0; i < 2000; ++i) {
    const double angle = random.uniform(-M_PI, M_PI);
    const Vector2d direction(std::cos(angle), std::sin(angle));
    const Vector2d p = direction * random.uniform(0.5, 2.0) +
                       Vector2d(-direction.y(), direction.x()) * random.uniform(-0.7, 0.7);
    const SweptPath path(platform(), {direction.x(), direction.y(), 0.0}, 0.1, 3.0);
    const Corridor corridor(platform(), direction, 0.1);
    EXPECT_EQ(path.meet(p, 0.02).relevance, corridor.classify(p, 0.02)) << i;
  }
}

}  // namespace
}  // namespace pilothouse
