// The executor of a simulated base that something in the way holds.
#include <gtest/gtest.h>

#include <cmath>

#include "test/simulated_base.hpp"

namespace pilothouse {
namespace {

/// Holds a robot that drives ahead at x = 1 as long as `held` says.
struct HeldDrive {
  explicit HeldDrive(Hold hold, BaseKind kind = BaseKind::kDifferential)
      : base(baseOf(kind)), executor({}, base), robot(base, {}), hold(hold) {
    executor.drive({{3, 0}}, std::nullopt, false, robot.pose());
  }
  ExecutorOutput step() {
    ExecutorInput input;
    input.now = now;
    input.pose = robot.pose();
    if (robot.pose().x >= 1.0 && hold != Hold::kNone) {
      input.hold = hold;
      input.reason = "a box";
    }
    ExecutorOutput output = executor.step(input);
    const bool ahead = output.wanted.vx > 0.0;
    robot.step(input.hold != Hold::kNone && ahead ? Twist2{} : output.wanted);
    now += kStep;
    return output;
  }
  BaseParameters base;
  MotionExecutor executor;
  SimulatedBase robot;
  Hold hold;
  double now = 0.0;
};

TEST(ExecutorHeld, HeldByWhatIsOnlyRememberedItGoesBackToLookThreeTimesThenWaits) {
  for (const BaseKind kind : {BaseKind::kDifferential, BaseKind::kOmnidirectional}) {
    HeldDrive held(Hold::kRemembered, kind);
    std::vector<double> distances;
    bool back = false;
    double from = 0.0, fastest_back = 0.0;
    ExecutorOutput output;
    for (int i = 0; i < 50 * 120 && output.text != "a box; looked again 3 times"; ++i) {
      output = held.step();
      const double x = held.robot.pose().x;
      if (output.wanted.vx < 0.0 && !back) {
        distances.push_back(0.0);
        from = x;
      }
      back = output.wanted.vx < 0.0 || (back && output.wanted.zero());
      if (back) distances.back() = std::max(distances.back(), from - x);
      fastest_back = std::max(fastest_back, -held.robot.twist().vx);
    }
    ASSERT_EQ(distances.size(), 3U);
    for (const double distance : distances) {
      EXPECT_GE(distance, 0.3);
      EXPECT_LE(distance, 0.4);
    }
    EXPECT_LE(fastest_back, 0.15 + 1e-9);
    EXPECT_EQ(output.state, ExecutorState::kWaiting);
    EXPECT_EQ(output.text, "a box; looked again 3 times");
    int waited = 0;
    while (waited < 50 * 60 && output.state == ExecutorState::kWaiting) {
      output = held.step();
      ++waited;
    }
    EXPECT_GT(waited, 50 * 2) << "for a while";
    EXPECT_LT(waited, 50 * 5) << "but not for good";
  }
}

TEST(ExecutorHeld, GoesOnWhenTheLookShowsThatTheWayIsFree) {
  HeldDrive held(Hold::kRemembered);
  ExecutorOutput output;
  for (int i = 0; i < 50 * 60 && output.state != ExecutorState::kReached; ++i) {
    output = held.step();
    if (output.wanted.vx < 0.0) held.hold = Hold::kNone;
  }
  EXPECT_EQ(output.state, ExecutorState::kReached);
}

TEST(ExecutorHeld, HeldByWhatIsSeenItWaitsWhereItStands) {
  HeldDrive held(Hold::kSeen);
  ExecutorOutput output;
  for (int i = 0; i < 50 * 40; ++i) {
    output = held.step();
    ASSERT_GE(output.wanted.vx, 0.0);
  }
  EXPECT_EQ(output.state, ExecutorState::kWaiting);
  EXPECT_EQ(output.text, "a box");
  EXPECT_GE(held.robot.pose().x, 0.99);
}

TEST(ExecutorHeld, HeldWithinTheToleranceOfItsEndItHasArrived) {
  const BaseParameters base = baseOf(BaseKind::kOmnidirectional);
  MotionExecutor executor({}, base);
  SimulatedBase robot(base, {});
  executor.drive({{1, 0}}, std::nullopt, false, robot.pose());
  ExecutorOutput output;
  ExecutorInput input;
  for (; input.now < 60.0 && output.state != ExecutorState::kReached; input.now += kStep) {
    input.pose = robot.pose();
    output = executor.step(input);
    robot.step(robot.pose().x > 0.98 ? Twist2{} : output.wanted);
  }
  EXPECT_EQ(output.state, ExecutorState::kReached);
  EXPECT_NEAR(robot.pose().x, 1.0, ExecutorParameters().position_tolerance);
}

}  // namespace
}  // namespace pilothouse
