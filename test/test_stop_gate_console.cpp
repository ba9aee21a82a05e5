// Promises of the stop gate: the console, its stop, and driving by hand over its link.
#include "core/motion/stop_gate.hpp"

#include <gtest/gtest.h>

#include "test/driving_gate.hpp"

namespace pilothouse {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

TEST(StopGateConsole, StopsInTimeWhenTheConsoleIsGoneThatWasThere) {
  Driving robot;
  robot.console = true;
  robot.run(0.2);
  EXPECT_EQ(robot.out.status, GateStatus::kRunning);
  robot.console = false;
  expectInTime(robot.timeToZero());
  robot.expectLatched(StopCause::kOperatorGone);
  robot.expectHeld();
}

TEST(StopGateConsole, StopsInTimeWhenTheConsoleHearsNothingAnyMore) {
  Driving robot;
  robot.console = true;
  robot.run(0.2);
  robot.console_hears = false;  // its words still come, but it does not know ours
  expectInTime(robot.timeToZero());
  robot.expectLatched(StopCause::kOperatorGone);
}

TEST(StopGateConsole, AConsoleThatLeavesInGoodOrderIsNoFault) {
  Driving robot;
  robot.console = true;
  robot.run(0.2);
  robot.console = false;
  robot.say(false, false, true);
  robot.run(2.0);
  EXPECT_EQ(robot.out.status, GateStatus::kRunning) << describe(robot.out.stopped, "", "");
}

TEST(StopGateConsole, AConsoleThatWasGoneBeforeArmingIsNoFault) {
  GateBench bench;
  bench.console = true;
  bench.run(0.5);
  bench.console = false;
  bench.run(0.5);
  EXPECT_TRUE(bench.arm());
  bench.run(1.0);
  EXPECT_EQ(bench.out.status, GateStatus::kRunning) << describe(bench.out.stopped, "", "");
}

TEST(StopGateConsole, TheOperatorsStopActsAtOnceAndHolds) {
  Driving robot;
  robot.say(true, false, false);
  robot.tick();
  robot.expectLatched(StopCause::kOperator);
  EXPECT_EQ(robot.out.stopped.console, 0);
  robot.expectHeld();
}

TEST(StopGateConsole, AStopCountsEvenWhenALaterMessageOvertookIt) {
  Driving robot;
  robot.say(true, false, false);
  robot.say(false, false, false);  // before the gate looked
  robot.tick();
  robot.expectLatched(StopCause::kOperator);
  robot.expectHeld();  // leaving it out does not arm again
}

TEST(StopGateConsole, TheServiceStops) {
  Driving robot;
  ++robot.in.stop_requests;
  robot.tick();
  robot.expectLatched(StopCause::kOperator);
  robot.expectHeld();
}

TEST(StopGateConsole, AStopWinsOverArmingInTheSameStep) {
  GateBench bench;
  bench.run(0.2);
  ++bench.in.stop_requests;
  EXPECT_FALSE(bench.arm());
}

TEST(StopGateConsole, WhileTheStopIsPressedItCannotBeArmed) {
  GateBench bench;
  bench.run(0.2);
  for (int i = 0; i < 50; ++i) {
    bench.say(true, false, false);
    EXPECT_FALSE(bench.arm());
  }
  bench.say(false, false, false);
  EXPECT_TRUE(bench.arm());
}

TEST(StopGateConsole, AStopPressedOnAConsoleThatIsGoneHoldsForAWhile) {
  GateBench bench;
  bench.run(0.2);
  bench.say(true, false, false);
  bench.run(1.0);
  EXPECT_FALSE(bench.arm());
  EXPECT_EQ(bench.out.obstacle.cause, StopCause::kStopPressed);
  bench.run(6.0);
  EXPECT_TRUE(bench.arm()) << "a dead console must not lock the robot for ever";
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

TEST(StopGateConsole, ACommandHeldByHandMustBeLetGoBeforeArming) {
  GateBench bench;
  bench.console = true;
  bench.source = CommandSource::kTeleop;
  EXPECT_FALSE(bench.armed());
  EXPECT_EQ(bench.out.obstacle.cause, StopCause::kCommandHeld);
  bench.wanted = {};
  EXPECT_TRUE(bench.armed());
}

TEST(StopGateConsole, ACommandThatTheLimiterHoldsAtZeroIsHeldToo) {
  GateBench bench;
  bench.console = true;
  bench.source = CommandSource::kTeleop;
  bench.run(0.2);
  bench.in.command.twist = {};
  bench.command = false;  // limited to zero; the wish is not
  EXPECT_FALSE(bench.arm());
  EXPECT_EQ(bench.out.obstacle.cause, StopCause::kCommandHeld);
}

TEST(StopGateConsole, DrivesByHandThoughTheConsolesClockIsOff) {
  ByHand robot;
  robot.run(1.0);
  EXPECT_EQ(robot.out.status, GateStatus::kRunning) << describe(robot.out.stopped, "", "");
  EXPECT_EQ(robot.out.command.vx, 0.2);
}

TEST(StopGateConsole, ATeleopCommandWithoutAConsoleIsNotActedOn) {
  GateBench bench;
  bench.source = CommandSource::kTeleop;
  bench.wanted = {};
  EXPECT_TRUE(bench.armed());
  bench.wanted = {0.2, 0.0, 0.0};
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(bench.tick().command.zero());
}

TEST(StopGateConsole, ATeleopCommandThatAStalledLinkDeliversLateIsOld) {
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

TEST(StopGateConsole, NoTeleopCommandOlderThanItsLimitIsActedOnOverALossyLink) {
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

TEST(StopGateConsole, ABeatOfAnEarlierLifeIsNoSignOfLife) {
  GateBench bench;
  bench.run(0.2);
  bench.say(false, true, false);
  bench.in.consoles[0].gate_beat = bench.out.beat + 100000;
  bench.tick();
  EXPECT_EQ(bench.out.operator_age, kInfinite);
}

TEST(StopGateConsole, WhereAConsoleIsRequiredItCannotBeArmedWithout) {
  GateBench bench;
  bench.parameters.require_operator = true;
  EXPECT_FALSE(bench.armed());
  EXPECT_EQ(bench.out.obstacle.cause, StopCause::kNoOperator);
  bench.console = true;
  EXPECT_TRUE(bench.armed());
}

}  // namespace
}  // namespace pilothouse
