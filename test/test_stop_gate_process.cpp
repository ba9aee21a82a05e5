// The real process: its topics and services, and what becomes of it when it is killed.
#include <gtest/gtest.h>
#include <signal.h>

#include <functional>
#include <memory>

#include "bench/node_process.hpp"
#include "test/robot_stand_in.hpp"

namespace pilothouse {
namespace {

bool stopped(const StopState& state, double) {
  return state.state == StopState::STOPPED;
}
bool idle(const StopState& state, double) {
  return state.state == StopState::IDLE;
}
bool armable(const StopState& state, double) {
  return stopped(state, 0.0) && state.can_arm;
}
bool running(const StopState& state, double speed) {
  return state.state == StopState::RUNNING && speed != 0.0;
}

/// Any input may be late on a busy computer, and the gate stops then; nothing else may stop it.
bool byLoad(const StopState& state) {
  return state.cause == StopState::STALE_PERCEPTION || state.cause == StopState::STALE_ODOMETRY ||
         state.cause == StopState::STALE_LIMIT || state.cause == StopState::CLOCK;
}

struct StopGateProcess : testing::Test {
  // One for all: its connections must not begin anew with each test.
  static void SetUpTestSuite() { stand_in = std::make_unique<RobotStandIn>(); }
  static void TearDownTestSuite() { stand_in.reset(); }
  void SetUp() override {
    robot.odometry = robot.perception = robot.limiter = robot.command = true;
    robot.console = robot.pressed = robot.driving = robot.restamped = robot.turned = false;
    robot.speed = 0.2;
    // The console of an earlier test is gone, as the gate knows it.
    ASSERT_TRUE(robot.wait([](const StopState& state, double) {
      return armable(state, 0.0) && !(state.operator_age < 0.4F);
    })) << robot.state().obstacle_to_arming;
  }
  void TearDown() override { robot.call("stop_gate/stop"); }

  /// A busy computer may make something stale, and the gate stop, at any instant: then once more.
  template <class Condition>
  void armUntil(Condition holds) {
    std_srvs::Trigger::Response answer;
    for (int i = 0; i < kTries; ++i) {
      ASSERT_TRUE(robot.wait([this](const StopState& state, double) {
        return armable(state, 0.0) && (!robot.console || state.operator_age < 0.2F);
      })) << robot.state().obstacle_to_arming;
      answer = robot.call("stop_gate/arm");
      // The answer may overtake the states that were published before it.
      const std::uint32_t beat = robot.state().beat + 5;
      bool held = false;
      robot.wait([&](const StopState& state, double speed) {
        held = answer.success && holds(state, speed);
        return held || (state.beat > beat && stopped(state, speed));
      });
      if (held) return;
      ASSERT_TRUE(!answer.success || byLoad(robot.state())) << robot.state().text;
    }
    FAIL() << answer.message << ": " << robot.state().text;
  }
  void arm() { armUntil(running); }
  /// Drives, and is stopped by what `fail` does. @return the time until zero [s].
  double expectStopped(const std::function<void()>& fail, const std::function<void()>& heal,
                       std::uint8_t cause) {
    for (int i = 0; i < kTries; ++i) {
      heal();
      arm();
      const ros::WallTime from = ros::WallTime::now();
      fail();
      EXPECT_TRUE(robot.wait([](const StopState&, double speed) { return speed == 0.0; }));
      const double seconds = (ros::WallTime::now() - from).toSec();
      EXPECT_TRUE(robot.wait(stopped));
      if (robot.state().cause == cause) return seconds;
      EXPECT_TRUE(byLoad(robot.state())) << robot.state().text;
    }
    ADD_FAILURE() << robot.state().text;
    return 1e9;
  }
  /// The shortest of three: a busy computer makes one late, not all.
  void expectStops(std::atomic<bool>& input, bool failing, std::uint8_t cause) {
    double shortest = 1e9;
    for (int i = 0; i < 3; ++i) {
      shortest = std::min(
          shortest, expectStopped([&] { input = failing; }, [&] { input = !failing; }, cause));
      expectHeldAt(input, !failing);
    }
    EXPECT_LE(shortest, 0.35);
  }
  /// In good order again, it stays where it is.
  void expectHeldAt(std::atomic<bool>& input, bool good) {
    input = good;
    ASSERT_TRUE(robot.wait(armable)) << robot.state().obstacle_to_arming;
    robot.fastest();
    const std::uint32_t beat = robot.state().beat;
    ASSERT_TRUE(robot.wait([&](const StopState& s, double) { return s.beat > beat + 20; }));
    EXPECT_EQ(robot.fastest(), 0.0);
  }

  static constexpr int kTries = 5;
  static std::unique_ptr<RobotStandIn> stand_in;
  RobotStandIn& robot = *stand_in;
};
std::unique_ptr<RobotStandIn> StopGateProcess::stand_in;

TEST_F(StopGateProcess, ArmsAndPassesCommands) {
  EXPECT_TRUE(robot.state().cause == StopState::NOT_ARMED ||
              robot.state().cause == StopState::OPERATOR);
  arm();
  EXPECT_TRUE(robot.wait([](const StopState& s, double v) {
    return v == 0.2 && s.command.linear.x == 0.2 && s.command_age < 0.3F && s.odometry_age < 0.3F;
  }));
}

TEST_F(StopGateProcess, StopsWithoutPerception) {
  expectStops(robot.perception, false, StopState::STALE_PERCEPTION);
}
TEST_F(StopGateProcess, StopsWithoutOdometry) {
  expectStops(robot.odometry, false, StopState::STALE_ODOMETRY);
}
TEST_F(StopGateProcess, StopsByOdometryThatTheDoorsRefuse) {
  expectStops(robot.turned, true, StopState::STALE_ODOMETRY);
}
TEST_F(StopGateProcess, StopsWithoutTheLimiter) {
  expectStops(robot.limiter, false, StopState::STALE_LIMIT);
}
TEST_F(StopGateProcess, StopsWithoutTheCommand) {
  expectStops(robot.command, false, StopState::STALE_COMMAND);
}
TEST_F(StopGateProcess, StopsAtACommandThatIsRepeated) {
  expectStops(robot.restamped, true, StopState::STALE_COMMAND);
}
TEST_F(StopGateProcess, StopsWithoutTheConsoleThatWasThere) {
  expectStops(robot.console, false, StopState::OPERATOR_GONE);
}

TEST_F(StopGateProcess, StopsByTheConsolesKeyAndByTheService) {
  robot.console = true;
  expectStopped([this] { robot.pressed = true; }, [this] { robot.pressed = false; },
                StopState::OPERATOR);
  EXPECT_EQ(robot.state().text, "stopped from console \"laptop\"");
  const auto refused = robot.call("stop_gate/arm");
  EXPECT_FALSE(refused.success);
  EXPECT_NE(refused.message.find("pressed"), std::string::npos) << refused.message;
  robot.pressed = false;
  arm();
  EXPECT_TRUE(robot.call("stop_gate/stop").success);
  EXPECT_TRUE(robot.wait(stopped));
}

TEST_F(StopGateProcess, IsIdleWithoutACommand) {
  robot.speed = 0.0;
  for (int i = 0; i < kTries; ++i) {
    robot.command = true;
    // Commands of zero have come in: the one before may still be driven.
    std::uint32_t moved = 0;
    armUntil([&moved](const StopState& s, double speed) {
      if (moved == 0 || s.state != StopState::RUNNING || speed != 0.0) moved = s.beat;
      return s.state == StopState::RUNNING && s.beat - moved > 10;
    });
    robot.command = false;
    ASSERT_TRUE(
        robot.wait([](const StopState& s, double) { return idle(s, 0.0) || stopped(s, 0.0); }));
    if (robot.state().state == StopState::IDLE) return;
    ASSERT_TRUE(byLoad(robot.state())) << robot.state().text;
  }
  FAIL() << robot.state().text;
}

TEST_F(StopGateProcess, NeverPassesWhatIsNotANumber) {
  robot.fastest();
  expectStopped([this] { robot.speed = std::numeric_limits<double>::quiet_NaN(); },
                [this] { robot.speed = 0.2; }, StopState::BAD_COMMAND);
  EXPECT_LE(robot.fastest(), 0.2);
  robot.speed = 100.0;
  EXPECT_FALSE(robot.call("stop_gate/arm").success);
  EXPECT_EQ(robot.fastest(), 0.0);
}

TEST_F(StopGateProcess, AnswersASecondPublisherByAStop) {
  ros::NodeHandle handle;
  {
    ros::Publisher other;  // from this process, under another name than the gate's; a silent one
    expectStopped([&] { other = handle.advertise<geometry_msgs::Twist>("cmd_vel", 1); },
                  [&] { other.shutdown(); }, StopState::SECOND_PUBLISHER);
    geometry_msgs::Twist twist;
    twist.linear.x = 0.4;
    other.publish(twist);
    ASSERT_TRUE(robot.wait([](const StopState&, double speed) { return speed == 0.0; }));
    EXPECT_NE(robot.state().text.find("test_stop_gate_process"), std::string::npos)
        << robot.state().text;
    EXPECT_FALSE(robot.call("stop_gate/arm").success);
  }
  ASSERT_TRUE(robot.wait(armable)) << robot.state().obstacle_to_arming;
}

TEST_F(StopGateProcess, KilledItComesBackNotArmed) {
  arm();
  const pid_t process = bench::processOf("/stop_gate");
  ASSERT_GT(process, 0);
  const std::uint32_t beat = robot.state().beat;
  ASSERT_EQ(kill(process, SIGKILL), 0);
  ASSERT_TRUE(robot.wait([&](const StopState& state, double speed) {
    return state.cause == StopState::NOT_ARMED && state.can_arm && speed == 0.0;
  })) << robot.state().text;
  EXPECT_NE(robot.state().beat, beat);
  EXPECT_NE(bench::processOf("/stop_gate"), process);
}

}  // namespace
}  // namespace pilothouse

int main(int argc, char** argv) {
  ros::init(argc, argv, "test_stop_gate_process");
  testing::InitGoogleTest(&argc, argv);
  ros::NodeHandle keeps_ros_alive;
  return RUN_ALL_TESTS();
}
