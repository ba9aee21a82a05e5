// Promises of the stop gate: arming, commands, silence, a second publisher.
#include "core/motion/stop_gate.hpp"

#include <gtest/gtest.h>

#include "test/driving_gate.hpp"

namespace pilothouse {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();

TEST(StopGate, StartsNotArmedAndPublishesZero) {
  GateBench bench;
  for (int i = 0; i < 100; ++i) {
    EXPECT_TRUE(bench.tick().command.zero());
    EXPECT_EQ(bench.out.status, GateStatus::kStopped);
    EXPECT_EQ(bench.out.stopped.cause, StopCause::kNotArmed);
  }
  EXPECT_FALSE(bench.out.obstacle) << "a person may arm now";
}

TEST(StopGate, CountsItsBeats) {
  GateBench bench;
  const std::uint32_t first = bench.tick().beat;
  EXPECT_EQ(bench.tick().beat, first + 1);
}

TEST(StopGate, PassesCommandsAsTheyAreOnceArmed) {
  Driving();
}

TEST(StopGate, StopsInTimeWhenPerceptionIsStale) {
  Driving robot;
  robot.perception = false;
  expectInTime(robot.timeToZero());
  robot.expectLatched(StopCause::kStalePerception);
  robot.expectHeld();
}

TEST(StopGate, StopsInTimeWhenTheLimiterIsSilent) {
  Driving robot;
  robot.limiter = robot.command = false;
  expectInTime(robot.timeToZero());
  robot.expectLatched(StopCause::kStaleLimit);
  robot.expectHeld();
}

TEST(StopGate, StopsInTimeWhenTheCommandFallsSilentInMotion) {
  Driving robot;
  robot.command = false;
  expectInTime(robot.timeToZero());
  robot.expectLatched(StopCause::kStaleCommand);
  robot.expectHeld();
}

TEST(StopGate, WithoutACommandItIsIdleWhichIsNoFault) {
  Driving robot;
  robot.wanted = {};
  robot.tick();
  robot.command = false;
  robot.run(1.0);
  EXPECT_EQ(robot.out.status, GateStatus::kIdle);
  EXPECT_TRUE(robot.out.command.zero());
  robot.command = true;
  robot.wanted = {0.1, 0.0, 0.0};
  EXPECT_EQ(robot.tick().command.vx, 0.1);
}

TEST(StopGate, ASecondPublisherThatSpeaksStopsAtOnce) {
  Driving robot;
  robot.in.other_heard = robot.now;
  robot.tick();
  robot.expectLatched(StopCause::kSecondPublisher);
  EXPECT_FALSE(robot.arm()) << "it may speak again";
  robot.expectHeld();
  EXPECT_TRUE(robot.arm());
}

TEST(StopGate, ASecondPublisherThatIsSilentStopsToo) {
  Driving robot;
  robot.in.other_publisher = true;
  robot.tick();
  robot.expectLatched(StopCause::kSecondPublisher);
  robot.run(5.0);
  EXPECT_FALSE(robot.arm());
  robot.in.other_publisher = false;
  EXPECT_TRUE(robot.arm());
}

TEST(StopGate, BadCommandsNeverPass) {
  const Twist2 bad[] = {{kNan, 0, 0},       {0, kNan, 0}, {0, 0, kNan},     {kInfinite, 0, 0},
                        {0, 0, -kInfinite}, {0.7, 0, 0},  {0.5, -0.5, 0.0}, {0, 0, 1.7}};
  for (const Twist2& twist : bad) {
    Driving robot;
    robot.wanted = twist;
    robot.tick();
    robot.expectLatched(StopCause::kBadCommand);
    EXPECT_FALSE(robot.arm()) << "while it lasts";
    robot.wanted = {0.1, 0.0, 0.0};
    robot.expectHeld();
  }
}

TEST(StopGate, CommandsOutOfThePlaneNeverPass) {
  for (const double off : {0.1, kNan, kInfinite}) {
    Driving robot;
    robot.in.command.off_plane = off;
    robot.tick();
    robot.expectLatched(StopCause::kBadCommand);
  }
}

TEST(StopGate, ADifferentialBaseGetsNoSidewaysCommand) {
  Driving robot;
  robot.parameters.can_go_sideways = false;
  robot.wanted = {0.1, 0.01, 0.0};
  robot.tick();
  robot.expectLatched(StopCause::kBadCommand);
}

TEST(StopGate, RoundingAtTheLimitIsNoFault) {
  Driving robot;
  robot.wanted = {robot.parameters.max_speed * 1.0001, 0.0,
                  robot.parameters.max_turn_rate * 1.0001};
  EXPECT_EQ(robot.tick().status, GateStatus::kRunning);
}

TEST(StopGate, CannotBeArmedWhileAnythingIsMissing) {
  bool GateBench::*const inputs[] = {&GateBench::perception, &GateBench::odometry,
                                     &GateBench::limiter};
  for (const auto input : inputs) {
    GateBench bench;
    bench.*input = false;
    EXPECT_FALSE(bench.armed());
    EXPECT_FALSE(describe(bench.out.obstacle, "", "").empty());
    bench.*input = true;
    EXPECT_TRUE(bench.armed());
  }
}

TEST(StopGate, ATaskMayGoOnAfterArming) {
  GateBench bench;
  EXPECT_TRUE(bench.armed());
  EXPECT_EQ(bench.tick().command.vx, 0.3);
}

TEST(StopGate, ANewArmingIsNeededForEachRequestOnlyOnce) {
  GateBench bench;
  bench.odometry = false;
  EXPECT_FALSE(bench.armed());
  bench.odometry = true;
  bench.run(1.0);
  EXPECT_EQ(bench.out.status, GateStatus::kStopped) << "a refused request must not act later";
}

TEST(StopGate, EveryCauseHasWords) {
  for (int cause = 1; cause <= static_cast<int>(StopCause::kNoOperator); ++cause) {
    const StopFinding finding{static_cast<StopCause>(cause), 0.41, 0.3, 0};
    EXPECT_GT(describe(finding, "laptop", "/other").size(), 10U);
    EXPECT_EQ(describe(finding, "laptop", "/other").find("unknown cause"), std::string::npos);
  }
  EXPECT_EQ(describe({StopCause::kStaleOdometry, 0.41, 0.3, -1}, "", ""),
            "odometry is 0.41 s old, limit 0.30 s");
}

TEST(StopGate, ParametersOutOfRangeAreNamed) {
  GateParameters p;
  EXPECT_TRUE(validate(p).empty());
  p.odometry_timeout = kNan;
  p.operator_timeout = 0.6;
  ASSERT_EQ(validate(p).size(), 2U);
  EXPECT_EQ(validate(p)[1], "operator_timeout is 0.6, expected 0.05 to 0.5");
}

}  // namespace
}  // namespace pilothouse
