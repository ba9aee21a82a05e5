#include "core/motion/kinematics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "sim/random.hpp"

namespace pilothouse {
namespace {

constexpr double kPi = 3.14159265358979323846;

BaseParameters baseOf(BaseKind kind) {
  BaseParameters base;
  base.kind = kind;
  base.track = 0.34;
  base.wheelbase = kind == BaseKind::kDifferential ? 0.0 : 0.40;
  return base;
}

Twist2 randomTwist(sim::Random& random, BaseKind kind, double most = 2.0) {
  Twist2 twist{random.uniform(-most, most), random.uniform(-most, most),
               random.uniform(-most, most)};
  if (kind == BaseKind::kDifferential) twist.vy = 0.0;
  return twist;
}

class EveryBase : public testing::TestWithParam<BaseKind> {};

TEST_P(EveryBase, GoesFromTwistToWheelsAndBack) {
  const Kinematics kinematics(baseOf(GetParam()));
  sim::Random random(1);
  WheelStates states;
  for (int i = 0; i < 100000; ++i) {
    const Twist2 twist = randomTwist(random, GetParam());
    states = kinematics.inverse(twist, states);
    const WheelMotion motion = kinematics.forward(states);
    ASSERT_NEAR(motion.twist.vx, twist.vx, 1e-12);
    ASSERT_NEAR(motion.twist.vy, twist.vy, 1e-12);
    ASSERT_NEAR(motion.twist.w, twist.w, 1e-12);
    ASSERT_NEAR(motion.slip, 0.0, 1e-12);
  }
}

TEST_P(EveryBase, ScalesWithinItsLimitsAndKeepsTheShapeOfThePath) {
  const BaseParameters base = baseOf(GetParam());
  sim::Random random(2);
  for (int i = 0; i < 100000; ++i) {
    const Twist2 twist = randomTwist(random, GetParam(), std::pow(10.0, random.uniform(-2.0, 6.0)));
    const Twist2 limited = withinLimits(twist, base);
    ASSERT_LE(limited.linear(), base.max_speed);
    ASSERT_LE(std::abs(limited.w), base.max_turn_rate);
    const bool sound = twist.linear() <= base.max_speed && std::abs(twist.w) <= base.max_turn_rate;
    const double scale = limited.w / twist.w;
    ASSERT_NEAR(limited.vx, scale * twist.vx, 1e-9);
    ASSERT_NEAR(limited.vy, scale * twist.vy, 1e-9);
    if (sound) {
      ASSERT_EQ(scale, 1.0);
    } else {
      ASSERT_NEAR(
          std::max(limited.linear() / base.max_speed, std::abs(limited.w) / base.max_turn_rate),
          1.0, 1e-9)
          << "as fast as it may";
    }
  }
}

TEST_P(EveryBase, MakesNothingOfWhatIsNotFinite) {
  const BaseParameters base = baseOf(GetParam());
  const Kinematics kinematics(base);
  const double inf = std::numeric_limits<double>::infinity();
  for (const double bad : {std::nan(""), inf, -inf, std::numeric_limits<double>::max()}) {
    for (const Twist2& twist : {Twist2{bad, 0.1, 0.1}, {0.1, bad, 0.1}, {0.1, 0.1, bad}}) {
      EXPECT_TRUE(withinLimits(twist, base).finite());
      if (twist.finite()) continue;
      EXPECT_TRUE(withinLimits(twist, base).zero());
      for (const auto& state : kinematics.inverse(twist, {})) EXPECT_EQ(state.speed, 0.0);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Three, EveryBase,
                         testing::Values(BaseKind::kFourWheelSteered, BaseKind::kDifferential,
                                         BaseKind::kOmnidirectional));

TEST(SteeredBase, NeverTurnsAWheelMoreThanAQuarter) {
  const Kinematics kinematics(baseOf(BaseKind::kFourWheelSteered));
  sim::Random random(3);
  WheelStates states;
  for (int i = 0; i < 100000; ++i) {
    const WheelStates next =
        kinematics.inverse(randomTwist(random, BaseKind::kFourWheelSteered), states);
    for (std::size_t w = 0; w < 4; ++w) {
      ASSERT_LE(std::abs(wrapped(next[w].angle - states[w].angle)), 0.5 * kPi + 1e-9);
    }
    states = next;
  }
}

TEST(SteeredBase, BacksWithoutSteering) {
  const Kinematics kinematics(baseOf(BaseKind::kFourWheelSteered));
  for (const auto& state : kinematics.inverse({-0.5, 0.0, 0.0}, {})) {
    EXPECT_NEAR(state.angle, 0.0, 1e-12);
    EXPECT_NEAR(state.speed, -0.5, 1e-12);
  }
}

TEST(SteeredBase, KeepsItsAnglesAtRest) {
  const Kinematics kinematics(baseOf(BaseKind::kFourWheelSteered));
  const WheelStates aside = kinematics.inverse({0.0, 0.3, 0.0}, {});
  EXPECT_NEAR(std::abs(aside[0].angle), 0.5 * kPi, 1e-12);
  const WheelStates rest = kinematics.inverse({}, aside);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(rest[i].angle, wrapped(aside[i].angle));
    EXPECT_EQ(rest[i].speed, 0.0);
  }
  WheelStates unknown;
  unknown[0].angle = std::nan("");
  EXPECT_TRUE(std::isfinite(kinematics.inverse({}, unknown)[0].angle));
}

TEST(SteeredBase, DrivesOnlyAsFarAsItsWheelsPointTheRightWay) {
  const Kinematics kinematics(baseOf(BaseKind::kFourWheelSteered));
  const WheelStates ahead = kinematics.inverse({0.3, 0.0, 0.0}, {});
  EXPECT_EQ(kinematics.alignment(ahead, ahead), 1.0);
  EXPECT_NEAR(kinematics.alignment({}, kinematics.inverse({0.0, 0.3, 0.0}, {})), 0.0, 1e-12);
  const WheelStates oblique = kinematics.inverse({0.3, 0.3, 0.0}, {});
  EXPECT_NEAR(kinematics.alignment({}, oblique), std::sqrt(0.5), 1e-12);
}

TEST(SteeredBase, ReportsTheSlipOfWheelsThatDisagree) {
  const Kinematics kinematics(baseOf(BaseKind::kFourWheelSteered));
  WheelStates states = kinematics.inverse({0.4, 0.0, 0.0}, {});
  states[0].speed = 0.0;
  const WheelMotion motion = kinematics.forward(states);
  EXPECT_NEAR(motion.twist.vx, 0.3, 1e-12);
  EXPECT_GT(motion.slip, 0.05);
}

TEST(MecanumBase, ReportsTheSlipOfWheelsThatDisagree) {
  const Kinematics kinematics(baseOf(BaseKind::kOmnidirectional));
  WheelStates states = kinematics.inverse({0.4, 0.0, 0.0}, {});
  states[0].speed = -0.4;
  EXPECT_GT(kinematics.forward(states).slip, 0.1);
}

TEST(DifferentialBase, LeavesOutTheSidewaysPart) {
  const BaseParameters base = baseOf(BaseKind::kDifferential);
  EXPECT_EQ(withinLimits({0.2, 5.0, 0.3}, base).vy, 0.0);
  EXPECT_EQ(withinLimits({0.2, 5.0, 0.3}, base).vx, 0.2);
  const WheelStates states = Kinematics(base).inverse({0.2, 5.0, 1.0}, {});
  EXPECT_NEAR(states[0].speed, 0.2 - 0.17, 1e-12) << "left";
  EXPECT_NEAR(states[1].speed, 0.2 + 0.17, 1e-12) << "right";
}

}  // namespace
}  // namespace pilothouse
