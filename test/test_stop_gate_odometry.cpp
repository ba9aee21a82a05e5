// Promises of the stop gate: odometry that is silent or frozen.
#include "core/motion/stop_gate.hpp"

#include <gtest/gtest.h>

#include "test/driving_gate.hpp"

namespace pilothouse {
namespace {

TEST(StopGateOdometry, StopsInTimeWhenOdometryIsStale) {
  Driving robot;
  robot.odometry = false;
  expectInTime(robot.timeToZero());
  robot.expectLatched(StopCause::kStaleOdometry);
  robot.expectHeld();
}

TEST(StopGateOdometry, StopsInTimeWhenOdometryIsFrozenThoughItsStampsGoOn) {
  Driving robot;
  robot.frozen = true;
  expectInTime(robot.timeToZero());
  robot.expectLatched(StopCause::kStaleOdometry);
}

TEST(StopGateOdometry, OdometryOfARobotThatStandsIsNotFrozen) {
  Driving robot;
  robot.wanted = {};
  robot.run(0.1);
  robot.frozen = true;
  robot.run(2.0);
  EXPECT_EQ(robot.out.status, GateStatus::kRunning) << describe(robot.out.stopped, "", "");
}

TEST(StopGateOdometry, StopsWhenOdometryFrozenAtStandstillSaysThatADrivenRobotStands) {
  for (const Twist2& wanted : {Twist2{0.06, 0.0, 0.0}, Twist2{0.0, 0.0, 0.25}}) {
    GateBench robot;
    robot.wanted = wanted;
    robot.frozen = robot.stands = true;  // from before arming
    ASSERT_TRUE(robot.armed());
    const double from = robot.now;
    while (robot.now - from < 3.0 && !robot.tick().command.zero()) {
    }
    EXPECT_EQ(robot.out.stopped.cause, StopCause::kStaleOdometry)
        << describe(robot.out.stopped, "", "");
    EXPECT_GT(robot.now - from, 1.2) << "a base may take a while to start";
    EXPECT_LT(robot.now - from, 1.4);
  }
}

TEST(StopGateOdometry, StopsInTimeWhenOdometryStandsAtOnceInFullDrive) {
  Driving robot;
  robot.frozen = robot.stands = true;
  expectInTime(robot.timeToZero());
  robot.expectLatched(StopCause::kStaleOdometry);
  robot.run(0.5);
  EXPECT_TRUE(robot.arm()) << "a robot that stands says the same for long";
}

TEST(StopGateOdometry, StopsInTimeThoughTheLastReadingThatMovedWasMissed) {
  Driving robot;
  robot.stands = true;
  robot.tick();
  robot.frozen = true;
  expectInTime(robot.timeToZero());
  robot.expectLatched(StopCause::kStaleOdometry);
}

TEST(StopGateOdometry, ARobotThatStandsAtOnceByItsCommandIsNotFrozen) {
  Driving robot;
  robot.wanted = {};
  robot.tick();
  robot.frozen = robot.stands = true;
  robot.run(2.0);
  EXPECT_EQ(robot.out.status, GateStatus::kRunning) << describe(robot.out.stopped, "", "");
}

TEST(StopGateOdometry, ADrivenRobotThatIsHeldIsNotFrozenWhileItsReadingsDiffer) {
  Driving robot;
  robot.frozen = robot.stands = true;
  for (int i = 0; i < 400; ++i) {
    robot.in.odometry.pose.x += i % 2 ? 1e-9 : -1e-9;
    ASSERT_EQ(robot.tick().status, GateStatus::kRunning) << describe(robot.out.stopped, "", "");
  }
}

// A limiter or a ramp may send zero for a beat, and a base does not stand by that.
void expectStoppedThoughItDips(GateBench& robot, int first, int every, double within) {
  const Twist2 wanted = robot.wanted;
  const double from = robot.now;
  bool stopped = false;
  for (int i = first; robot.now - from < 3.0 && !stopped; ++i) {
    robot.wanted = i % every ? wanted : Twist2{};
    stopped = robot.tick().status == GateStatus::kStopped;
  }
  EXPECT_EQ(robot.out.stopped.cause, StopCause::kStaleOdometry)
      << "first " << first << ": " << describe(robot.out.stopped, "", "");
  EXPECT_LT(robot.now - from, within) << "first " << first;
}

TEST(StopGateOdometry, StopsInTimeWhenOdometryStandsAtOnceThoughTheCommandDips) {
  for (int first = 0; first < 10; ++first) {  // the dip just then, before, and after
    Driving robot;
    robot.frozen = robot.stands = true;
    expectStoppedThoughItDips(robot, first, 10, 0.35);
  }
}

TEST(StopGateOdometry, StopsWhenOdometryFrozenAtStandstillHidesBehindDips) {
  GateBench robot;
  robot.frozen = robot.stands = true;
  ASSERT_TRUE(robot.armed());
  expectStoppedThoughItDips(robot, 1, 10, 2.0);
}

TEST(StopGateOdometry, ARobotThatStoodAtOnceMayWaitAndStartSlowly) {
  Driving robot;
  const Twist2 wanted = robot.wanted;
  robot.wanted = {};
  robot.tick();
  robot.frozen = robot.stands = true;
  robot.run(0.6);
  robot.wanted = wanted;  // it takes its time
  robot.run(0.9);
  robot.frozen = robot.stands = false;
  robot.run(1.0);
  EXPECT_EQ(robot.out.status, GateStatus::kRunning) << describe(robot.out.stopped, "", "");
}

TEST(StopGateOdometry, ShortOrSlowCommandsDoNotAskOdometryToChange) {
  GateBench robot;
  robot.frozen = robot.stands = true;
  ASSERT_TRUE(robot.armed());
  for (int i = 0; i < 400; ++i) {
    robot.wanted = {i % 40 < 32 ? 0.3 : 0.0, 0.0, 0.0};  // never for a second
    ASSERT_EQ(robot.tick().status, GateStatus::kRunning) << describe(robot.out.stopped, "", "");
  }
  for (int i = 0; i < 400; ++i) {
    robot.wanted = {i % 2 ? 0.3 : 0.0, 0.0, 0.0};  // no longer than not
    ASSERT_EQ(robot.tick().status, GateStatus::kRunning) << describe(robot.out.stopped, "", "");
  }
  robot.wanted = {0.04, 0.0, 0.1};
  robot.run(4.0);
  EXPECT_EQ(robot.out.status, GateStatus::kRunning) << describe(robot.out.stopped, "", "");
}

}  // namespace
}  // namespace pilothouse
