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

TEST(ExecutorHeld, ANewOrderOnTheWayLeavesItTheWayBack) {
  HeldDrive held(Hold::kRemembered);
  while (held.robot.pose().x < 0.995) held.step();
  held.executor.drive({{3, 0.1}}, std::nullopt, false, held.robot.pose());
  double farthest = 0.0, back = 0.0;
  for (int i = 0; i < 50 * 8; ++i) {
    held.step();
    farthest = std::max(farthest, held.robot.pose().x);
    back = std::max(back, farthest - held.robot.pose().x);
  }
  EXPECT_GT(back, 0.3) << "it went back to look";
}

TEST(ExecutorHeld, AnOrderFromElsewhereHasNoWayBack) {
  HeldDrive held(Hold::kRemembered);
  while (held.robot.pose().x < 0.995) held.step();
  const Pose2 elsewhere{5.0, 5.0, 0.0};  // in another frame, say
  held.executor.drive({{9.0, 5.0}}, std::nullopt, false, elsewhere);
  ExecutorInput input;
  for (input.now = held.now; input.now < held.now + 3.0; input.now += kStep) {
    input.pose = elsewhere;
    input.hold = Hold::kRemembered;
    EXPECT_GE(held.executor.step(input).wanted.vx, 0.0);
  }
}

TEST(ExecutorHeld, HeldWhileItTurnsToLookItDoesNotGoOnTurning) {
  const BaseParameters base = baseOf(BaseKind::kDifferential);
  MotionExecutor executor({}, base);
  executor.drive({{3, 0}}, std::nullopt, false, {});
  ExecutorInput input;
  input.hold = Hold::kRemembered;
  input.held_by = Eigen::Vector2d(0.0, 0.4);  // beside it
  double looked = 0.0;
  for (; input.now < 10.0; input.now += kStep) {
    const bool looks = executor.step(input).text == "looks again";
    if (looked > 0.0 && !looks) break;
    if (looks) looked += kStep;
  }
  EXPECT_GT(looked, 0.5);
  EXPECT_LT(looked, 2.0) << "held, it cannot turn: it need not try for 6 s";
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
