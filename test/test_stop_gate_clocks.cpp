// Promises of the stop gate: stamps that lie, clocks that jump, a gate that was halted.
#include "core/motion/stop_gate.hpp"

#include <gtest/gtest.h>

#include "test/driving_gate.hpp"

namespace pilothouse {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();

TEST(StopGateClocks, ARepeatedOldCommandIsOld) {
  Driving robot;
  robot.command = false;
  const double from = robot.now;
  while (robot.now - from < 1.0 && robot.out.status == GateStatus::kRunning) {
    robot.in.command.arrival = robot.now;  // it comes again and again, by its old stamp
    robot.tick();
  }
  expectInTime(robot.now - from);
  robot.expectLatched(StopCause::kStaleCommand);
}

TEST(StopGateClocks, AReplayedCommandRefreshesNothing) {
  Driving robot;
  robot.command = false;
  const double newest = robot.in.command.stamp;
  for (int i = 1; robot.out.status == GateStatus::kRunning && i < 100; ++i) {
    static_cast<Arrival&>(robot.in.command) = {newest - 1.0 + 0.001 * i, robot.now};
    robot.tick();
  }
  robot.expectLatched(StopCause::kStaleCommand);
}

TEST(StopGateClocks, ACommandThatWasHeldUpIsAsOldAsItsOriginal) {
  Driving robot;
  robot.command = false;
  for (int i = 0; i < 100; ++i) {  // new every time, but made a second ago
    static_cast<Arrival&>(robot.in.command) = {robot.ros() - 1.0, robot.now};
    robot.tick();
  }
  robot.expectLatched(StopCause::kStaleCommand);
}

TEST(StopGateClocks, StampsOfTheFutureAreRefused) {
  GateBench bench;
  bench.odometry = false;
  for (int i = 0; i < 100; ++i) {
    static_cast<Arrival&>(bench.in.odometry) = {bench.ros() + 5.0, bench.now};
    bench.tick();
  }
  EXPECT_FALSE(bench.arm());
  EXPECT_EQ(bench.out.obstacle.cause, StopCause::kStaleOdometry);
}

TEST(StopGateClocks, AFrozenClockOfStampsDoesNotHideAge) {
  // /clock stands still, and all stamps with it: the steady clock goes on.
  Driving robot;
  const double ros = robot.ros();
  int steps = 0;
  for (; robot.out.status == GateStatus::kRunning && steps < 100; ++steps) {
    robot.now += GateBench::kPeriod;
    robot.in.now = {robot.now, ros};
    robot.out = step(robot.parameters, robot.state, robot.in);
  }
  EXPECT_LE(steps * GateBench::kPeriod, 0.35);
}

TEST(StopGateClocks, AJumpOfTheClockStopsAndForgetsStamps) {
  for (const double jump : {-100.0, -0.5, 1.0, 3600.0}) {
    Driving robot;
    robot.now += GateBench::kPeriod;
    robot.in.now = {robot.now, robot.ros() + jump};
    robot.out = step(robot.parameters, robot.state, robot.in);
    robot.expectLatched(StopCause::kClock);
    for (int i = 0; i < 50; ++i) {  // goes on in the new time, as a bag that begins again does
      robot.now += GateBench::kPeriod;
      const double ros = robot.ros() + jump;
      robot.in.now = {robot.now, ros};
      static_cast<Arrival&>(robot.in.odometry) = {ros, robot.now};
      robot.in.odometry.pose.x = robot.now;
      static_cast<Arrival&>(robot.in.limit) = {ros, robot.now};
      static_cast<Arrival&>(robot.in.command) = {ros, robot.now};
      robot.in.limit.perception_stamp = robot.in.limit.command_stamp = ros;
      robot.in.limit.source = CommandSource::kTask;
      robot.out = step(robot.parameters, robot.state, robot.in);
    }
    EXPECT_FALSE(robot.out.obstacle) << describe(robot.out.obstacle, "", "");
  }
}

TEST(StopGateClocks, AGateThatStoodStillItselfStops) {
  Driving robot;
  robot.tick(2.0);
  robot.expectLatched(StopCause::kClock);
  robot.expectHeld();
}

TEST(StopGateClocks, TimeThatIsNoNumberStops) {
  for (const GateTime& time : {GateTime{kNan, 1.7e9}, GateTime{100.5, kNan}, GateTime{99.0, 1.7e9},
                               GateTime{kInfinite, kInfinite}}) {
    Driving robot;
    robot.in.now = time;
    robot.out = step(robot.parameters, robot.state, robot.in);
    robot.expectLatched(StopCause::kClock);
  }
}

}  // namespace
}  // namespace pilothouse
