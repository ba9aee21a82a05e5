// Each promise of the stop gate, by name.
#include "core/motion/stop_gate.hpp"

#include <gtest/gtest.h>

#include "test/gate_bench.hpp"

namespace pilothouse {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Armed and driving.
struct Driving : GateBench {
  Driving() {
    EXPECT_TRUE(armed()) << describe(out.obstacle, "", "");
    EXPECT_EQ(tick().status, GateStatus::kRunning);
    EXPECT_EQ(out.command.vx, wanted.vx);
    EXPECT_EQ(out.command.w, wanted.w);
  }
  void expectLatched(StopCause cause) {
    EXPECT_EQ(out.status, GateStatus::kStopped);
    EXPECT_EQ(out.stopped.cause, cause) << describe(out.stopped, "", "");
    EXPECT_TRUE(out.command.zero());
  }
  /// All in good order again, but nobody arms.
  void expectHeld() {
    perception = odometry = limiter = command = true;
    for (int i = 0; i < 200; ++i) {
      EXPECT_TRUE(tick().command.zero());
      EXPECT_EQ(out.status, GateStatus::kStopped);
    }
  }
};

void expectInTime(double seconds) {
  EXPECT_GT(seconds, 0.2) << "a short gap is no fault";
  EXPECT_LE(seconds, 0.35);
}

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

TEST(StopGate, StopsInTimeWhenOdometryIsStale) {
  Driving robot;
  robot.odometry = false;
  expectInTime(robot.timeToZero());
  robot.expectLatched(StopCause::kStaleOdometry);
  robot.expectHeld();
}

TEST(StopGate, StopsInTimeWhenOdometryIsFrozenThoughItsStampsGoOn) {
  Driving robot;
  robot.frozen = true;
  expectInTime(robot.timeToZero());
  robot.expectLatched(StopCause::kStaleOdometry);
}

TEST(StopGate, OdometryOfARobotThatStandsIsNotFrozen) {
  Driving robot;
  robot.wanted = {};
  robot.run(0.1);
  robot.frozen = true;
  robot.run(2.0);
  EXPECT_EQ(robot.out.status, GateStatus::kRunning) << describe(robot.out.stopped, "", "");
}

TEST(StopGate, StopsWhenOdometryFrozenAtStandstillSaysThatADrivenRobotStands) {
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

TEST(StopGate, StopsInTimeWhenOdometryStandsAtOnceInFullDrive) {
  Driving robot;
  robot.frozen = robot.stands = true;
  expectInTime(robot.timeToZero());
  robot.expectLatched(StopCause::kStaleOdometry);
  robot.run(0.5);
  EXPECT_TRUE(robot.arm()) << "a robot that stands says the same for long";
}

TEST(StopGate, ARobotThatStandsAtOnceByItsCommandIsNotFrozen) {
  Driving robot;
  robot.wanted = {};
  robot.tick();
  robot.frozen = robot.stands = true;
  robot.run(2.0);
  EXPECT_EQ(robot.out.status, GateStatus::kRunning) << describe(robot.out.stopped, "", "");
}

TEST(StopGate, ADrivenRobotThatIsHeldIsNotFrozenWhileItsReadingsDiffer) {
  Driving robot;
  robot.frozen = robot.stands = true;
  for (int i = 0; i < 400; ++i) {
    robot.in.odometry.pose.x += i % 2 ? 1e-9 : -1e-9;
    ASSERT_EQ(robot.tick().status, GateStatus::kRunning) << describe(robot.out.stopped, "", "");
  }
}

TEST(StopGate, ShortOrSlowCommandsDoNotAskOdometryToChange) {
  Driving robot;
  robot.frozen = robot.stands = true;
  for (int i = 0; i < 400; ++i) {
    robot.wanted = {i % 40 ? 0.3 : 0.0, 0.0, 0.0};  // never for a second
    ASSERT_EQ(robot.tick().status, GateStatus::kRunning) << describe(robot.out.stopped, "", "");
  }
  robot.wanted = {0.04, 0.0, 0.1};
  robot.run(4.0);
  EXPECT_EQ(robot.out.status, GateStatus::kRunning) << describe(robot.out.stopped, "", "");
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

TEST(StopGate, StopsInTimeWhenTheConsoleIsGoneThatWasThere) {
  Driving robot;
  robot.console = true;
  robot.run(0.2);
  EXPECT_EQ(robot.out.status, GateStatus::kRunning);
  robot.console = false;
  expectInTime(robot.timeToZero());
  robot.expectLatched(StopCause::kOperatorGone);
  robot.expectHeld();
}

TEST(StopGate, StopsInTimeWhenTheConsoleHearsNothingAnyMore) {
  Driving robot;
  robot.console = true;
  robot.run(0.2);
  robot.console_hears = false;  // its words still come, but it does not know ours
  expectInTime(robot.timeToZero());
  robot.expectLatched(StopCause::kOperatorGone);
}

TEST(StopGate, AConsoleThatLeavesInGoodOrderIsNoFault) {
  Driving robot;
  robot.console = true;
  robot.run(0.2);
  robot.console = false;
  robot.say(false, false, true);
  robot.run(2.0);
  EXPECT_EQ(robot.out.status, GateStatus::kRunning) << describe(robot.out.stopped, "", "");
}

TEST(StopGate, AConsoleThatWasGoneBeforeArmingIsNoFault) {
  GateBench bench;
  bench.console = true;
  bench.run(0.5);
  bench.console = false;
  bench.run(0.5);
  EXPECT_TRUE(bench.arm());
  bench.run(1.0);
  EXPECT_EQ(bench.out.status, GateStatus::kRunning) << describe(bench.out.stopped, "", "");
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

TEST(StopGate, TheOperatorsStopActsAtOnceAndHolds) {
  Driving robot;
  robot.say(true, false, false);
  robot.tick();
  robot.expectLatched(StopCause::kOperator);
  EXPECT_EQ(robot.out.stopped.console, 0);
  robot.expectHeld();
}

TEST(StopGate, AStopCountsEvenWhenALaterMessageOvertookIt) {
  Driving robot;
  robot.say(true, false, false);
  robot.say(false, false, false);  // before the gate looked
  robot.tick();
  robot.expectLatched(StopCause::kOperator);
  robot.expectHeld();  // leaving it out does not arm again
}

TEST(StopGate, TheServiceStops) {
  Driving robot;
  ++robot.in.stop_requests;
  robot.tick();
  robot.expectLatched(StopCause::kOperator);
  robot.expectHeld();
}

TEST(StopGate, AStopWinsOverArmingInTheSameStep) {
  GateBench bench;
  bench.run(0.2);
  ++bench.in.stop_requests;
  EXPECT_FALSE(bench.arm());
}

TEST(StopGate, WhileTheStopIsPressedItCannotBeArmed) {
  GateBench bench;
  bench.run(0.2);
  for (int i = 0; i < 50; ++i) {
    bench.say(true, false, false);
    EXPECT_FALSE(bench.arm());
  }
  bench.say(false, false, false);
  EXPECT_TRUE(bench.arm());
}

TEST(StopGate, AStopPressedOnAConsoleThatIsGoneHoldsForAWhile) {
  GateBench bench;
  bench.run(0.2);
  bench.say(true, false, false);
  bench.run(1.0);
  EXPECT_FALSE(bench.arm());
  EXPECT_EQ(bench.out.obstacle.cause, StopCause::kStopPressed);
  bench.run(6.0);
  EXPECT_TRUE(bench.arm()) << "a dead console must not lock the robot for ever";
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

TEST(StopGate, ARepeatedOldCommandIsOld) {
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

TEST(StopGate, AReplayedCommandRefreshesNothing) {
  Driving robot;
  robot.command = false;
  const double newest = robot.in.command.stamp;
  for (int i = 1; robot.out.status == GateStatus::kRunning && i < 100; ++i) {
    static_cast<Arrival&>(robot.in.command) = {newest - 1.0 + 0.001 * i, robot.now};
    robot.tick();
  }
  robot.expectLatched(StopCause::kStaleCommand);
}

TEST(StopGate, ACommandThatWasHeldUpIsAsOldAsItsOriginal) {
  Driving robot;
  robot.command = false;
  for (int i = 0; i < 100; ++i) {  // new every time, but made a second ago
    static_cast<Arrival&>(robot.in.command) = {robot.ros() - 1.0, robot.now};
    robot.tick();
  }
  robot.expectLatched(StopCause::kStaleCommand);
}

TEST(StopGate, StampsOfTheFutureAreRefused) {
  GateBench bench;
  bench.odometry = false;
  for (int i = 0; i < 100; ++i) {
    static_cast<Arrival&>(bench.in.odometry) = {bench.ros() + 5.0, bench.now};
    bench.tick();
  }
  EXPECT_FALSE(bench.arm());
  EXPECT_EQ(bench.out.obstacle.cause, StopCause::kStaleOdometry);
}

TEST(StopGate, AFrozenClockOfStampsDoesNotHideAge) {
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

TEST(StopGate, AJumpOfTheClockStopsAndForgetsStamps) {
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

TEST(StopGate, AGateThatStoodStillItselfStops) {
  Driving robot;
  robot.tick(2.0);
  robot.expectLatched(StopCause::kClock);
  robot.expectHeld();
}

TEST(StopGate, TimeThatIsNoNumberStops) {
  for (const GateTime& time : {GateTime{kNan, 1.7e9}, GateTime{100.5, kNan}, GateTime{99.0, 1.7e9},
                               GateTime{kInfinite, kInfinite}}) {
    Driving robot;
    robot.in.now = time;
    robot.out = step(robot.parameters, robot.state, robot.in);
    robot.expectLatched(StopCause::kClock);
  }
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

struct ByHand : GateBench {
  ByHand() {
    console = true;
    source = CommandSource::kTeleop;
    wanted = {};
    EXPECT_TRUE(armed()) << describe(out.obstacle, "", "");
    wanted = {0.2, 0.0, 0.0};
  }
};

TEST(StopGate, ACommandHeldByHandMustBeLetGoBeforeArming) {
  GateBench bench;
  bench.console = true;
  bench.source = CommandSource::kTeleop;
  EXPECT_FALSE(bench.armed());
  EXPECT_EQ(bench.out.obstacle.cause, StopCause::kCommandHeld);
  bench.wanted = {};
  EXPECT_TRUE(bench.armed());
}

TEST(StopGate, ACommandThatTheLimiterHoldsAtZeroIsHeldToo) {
  GateBench bench;
  bench.console = true;
  bench.source = CommandSource::kTeleop;
  bench.run(0.2);
  bench.in.command.twist = {};
  bench.command = false;  // limited to zero; the wish is not
  EXPECT_FALSE(bench.arm());
  EXPECT_EQ(bench.out.obstacle.cause, StopCause::kCommandHeld);
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

TEST(StopGate, DrivesByHandThoughTheConsolesClockIsOff) {
  ByHand robot;
  robot.run(1.0);
  EXPECT_EQ(robot.out.status, GateStatus::kRunning) << describe(robot.out.stopped, "", "");
  EXPECT_EQ(robot.out.command.vx, 0.2);
}

TEST(StopGate, ATeleopCommandWithoutAConsoleIsNotActedOn) {
  GateBench bench;
  bench.source = CommandSource::kTeleop;
  bench.wanted = {};
  EXPECT_TRUE(bench.armed());
  bench.wanted = {0.2, 0.0, 0.0};
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(bench.tick().command.zero());
}

TEST(StopGate, ATeleopCommandThatAStalledLinkDeliversLateIsOld) {
  ByHand robot;
  robot.run(0.5);
  robot.command = false;  // its connection stalls, that of the sign of life does not
  const double from = robot.consoleClock();
  robot.run(0.2);
  EXPECT_EQ(robot.out.status, GateStatus::kRunning);
  robot.run(0.3);
  EXPECT_EQ(robot.out.status, GateStatus::kStopped);
  // Then all that was held up comes, each newer than the last, each a second old.
  for (int i = 0; i < 50; ++i) {
    static_cast<Arrival&>(robot.in.command) = {from + 0.02 * i - 1.0, robot.now};
    robot.tick();
    EXPECT_GT(robot.out.command_age, 0.9);
  }
}

TEST(StopGate, NoTeleopCommandOlderThanItsLimitIsActedOnOverALossyLink) {
  // Messages to and from the console are late by up to 200 ms each way and 30 % are lost.
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::uint32_t random = seed;
    const auto chance = [&random] {
      random = random * 1664525U + 1013904223U;
      return static_cast<double>(random >> 8U) / 16777216.0;
    };
    struct Late {
      double at = 0.0, made = 0.0;
      std::uint32_t beat = 0;
    };
    std::array<Late, 64> to_console{}, to_gate{};
    ByHand robot;
    robot.console = robot.command = false;
    std::uint32_t heard = robot.out.beat;
    double acted_on = 0.0;
    int passed = 0;
    for (int i = 0; i < 3000; ++i) {
      const double delay = 0.2 * (i % 1000 < 500 ? chance() : 1.0);
      const std::size_t at = static_cast<std::size_t>(i) % to_console.size();
      if (chance() > 0.3) to_console[at] = {robot.now + delay, robot.now, robot.out.beat};
      for (const Late& late : to_console)
        if (late.at <= robot.now && late.beat > heard) heard = late.beat;
      if (chance() > 0.3) to_gate[at] = {robot.now + delay, robot.now, heard};
      for (const Late& late : to_gate) {
        if (late.beat == 0 || late.at > robot.now || late.at <= robot.now - GateBench::kPeriod)
          continue;
        ConsoleMessage& m = robot.in.consoles[0];
        ++m.count;
        m.gate_beat = late.beat;
        m.driving = true;
        m.stamp = late.made + GateBench::kRosAhead + GateBench::kConsoleAhead;
        m.arrival = robot.now;
        static_cast<Arrival&>(robot.in.command) = {m.stamp, robot.now};
        robot.in.command.twist = {0.2, 0.0, 0.0};
      }
      const double made = robot.in.command.stamp - GateBench::kRosAhead - GateBench::kConsoleAhead;
      robot.wanted = {};  // nobody holds a key while it arms again
      if (robot.out.status == GateStatus::kStopped)
        robot.arm();
      else
        robot.tick();
      if (robot.out.command.zero()) continue;
      ++passed;
      acted_on = std::max(acted_on, robot.now - made);
    }
    EXPECT_LE(acted_on, robot.parameters.command_timeout + 0.01);
    EXPECT_GT(passed, 10) << "with small delays it does drive";
  }
}

TEST(StopGate, ABeatOfAnEarlierLifeIsNoSignOfLife) {
  GateBench bench;
  bench.run(0.2);
  bench.say(false, true, false);
  bench.in.consoles[0].gate_beat = bench.out.beat + 100000;
  bench.tick();
  EXPECT_EQ(bench.out.operator_age, kInfinite);
}

TEST(StopGate, WhereAConsoleIsRequiredItCannotBeArmedWithout) {
  GateBench bench;
  bench.parameters.require_operator = true;
  EXPECT_FALSE(bench.armed());
  EXPECT_EQ(bench.out.obstacle.cause, StopCause::kNoOperator);
  bench.console = true;
  EXPECT_TRUE(bench.armed());
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
