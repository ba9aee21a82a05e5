// The real nodelet motion executor in this process, fed by hand.
#include <gtest/gtest.h>

#include <regex>

#include "test/motion_harness.hpp"

namespace pilothouse {
namespace {

TEST(ExecutorNodelet, DrivesARouteReachesItAndFallsSilent) {
  MotionHarness robot;
  ASSERT_TRUE(robot.load("executor", "MotionExecutor"));
  ASSERT_TRUE(robot.runUntil([&] { return robot.route_state.state == RouteState::IDLE; }));
  ASSERT_TRUE(robot.runUntil([&] {
    robot.drive({{2.0, 0.0}}, "odom");
    return robot.wanted.twist.linear.x > 0.3 && robot.route_state.state == RouteState::DRIVING;
  }));
  EXPECT_NEAR(robot.route_state.distance_left, 2.0F, 0.05F);
  robot.x = 2.0;
  ASSERT_TRUE(robot.runUntil([&] { return robot.route_state.state == RouteState::REACHED; }));
  EXPECT_EQ(robot.wanted.twist.linear.x, 0.0);
}

TEST(ExecutorNodelet, RefusesWhatIsNoRouteAndSaysWhy) {
  MotionHarness robot;
  ASSERT_TRUE(robot.load("executor", "MotionExecutor"));
  const auto refused = [&](const std::vector<std::pair<double, double>>& points,
                           const std::string& frame, const std::string& reason) {
    robot.route_state = RouteState();
    EXPECT_TRUE(robot.runUntil([&] {
      robot.drive(points, frame);
      return robot.route_state.state == RouteState::REFUSED &&
             robot.route_state.text.find(reason) != std::string::npos;
    })) << robot.route_state.text;
  };
  ASSERT_TRUE(robot.runUntil([&] { return robot.route_state.state == RouteState::IDLE; }));
  refused(std::vector<std::pair<double, double>>(1001, {1.0, 1.0}), "odom", "1001 points");
  refused({{1.0, 0.0}, {std::nan(""), 0.0}}, "odom", "point 1 is nan");
  refused({{1.0, 0.0}}, "moon", "frame \"moon\"");
  refused({{1.0, 0.0}}, "", "frame \"\"");
}

TEST(ExecutorNodelet, StandsWhenItRefusesARouteOnTheWayAndGoesOnSayingSo) {
  MotionHarness robot;
  ASSERT_TRUE(robot.load("executor", "MotionExecutor"));
  ASSERT_TRUE(robot.runUntil([&] { return robot.route_state.state == RouteState::IDLE; }));
  const auto drives = [&] {
    robot.drive({{2.0, 0.0}}, "odom");
    return robot.wanted.twist.linear.x > 0.3 && robot.route_state.state == RouteState::DRIVING;
  };
  ASSERT_TRUE(robot.runUntil(drives));
  ASSERT_TRUE(robot.runUntil([&] {
    robot.drive({{0.0, 2.0}}, "moon");
    return robot.route_state.state == RouteState::REFUSED;
  }));
  // Not sent again: it stays at zero, and what it says is heard whoever comes late.
  EXPECT_TRUE(robot.runUntil([&] { return robot.wanted.twist.linear.x == 0.0; }));
  const ros::Time zero = robot.wanted.header.stamp;
  int said = 0;
  ros::Time last = robot.route_state.header.stamp;
  EXPECT_TRUE(robot.runUntil([&] {
    EXPECT_EQ(robot.wanted.twist.linear.x, 0.0);
    EXPECT_EQ(robot.route_state.state, RouteState::REFUSED);
    if (robot.route_state.header.stamp != last) ++said;
    last = robot.route_state.header.stamp;
    return said >= 5 && robot.wanted.header.stamp > zero;
  })) << said;
  EXPECT_TRUE(robot.runUntil(drives)) << "a good route drives again";
}

TEST(ExecutorNodelet, SaysOfWhichRouteItSpeaks) {
  MotionHarness robot;
  ASSERT_TRUE(robot.load("executor", "MotionExecutor"));
  ASSERT_TRUE(robot.runUntil([&] { return robot.route_state.state == RouteState::IDLE; }));
  EXPECT_TRUE(robot.route_state.route.isZero());
  const auto says = [&](double stamp, std::uint8_t state,
                        const std::vector<std::pair<double, double>>& points,
                        const std::string& frame) {
    robot.route_stamp = ros::Time(stamp);
    return robot.runUntil([&] {
      robot.drive(points, frame);
      return robot.route_state.state == state && robot.route_state.route == ros::Time(stamp);
    });
  };
  EXPECT_TRUE(says(3.5, RouteState::DRIVING, {{2.0, 0.0}}, "odom"));
  EXPECT_TRUE(says(4.5, RouteState::REFUSED, {{2.0, 0.0}}, "moon"));
  EXPECT_TRUE(says(5.5, RouteState::REACHED, {{0.0, 0.0}}, "odom"));
  EXPECT_TRUE(says(6.5, RouteState::IDLE, {}, "odom"));
}

/// A robot that drives in a frame, whose pose then falls silent: it waits, and says why and since
/// when.
void expectWaitsWithout(bool MotionHarness::*input, const std::string& frame,
                        const std::regex& reason) {
  MotionHarness robot;
  robot.localised = true;
  ASSERT_TRUE(robot.load("executor", "MotionExecutor"));
  const auto drives = [&] { return robot.wanted.twist.linear.x > 0.05; };
  ASSERT_TRUE(robot.runUntil([&] {
    if (robot.route_state.state == RouteState::IDLE ||
        robot.route_state.state == RouteState::REFUSED)
      robot.drive({{2.0, 0.0}}, frame);
    return drives();
  })) << robot.route_state.text;
  robot.*input = false;
  ASSERT_TRUE(robot.runUntil([&] {
    return robot.route_state.state == RouteState::WAITING &&
           std::regex_search(robot.route_state.text, reason);
  })) << robot.route_state.text;
  ASSERT_TRUE(robot.runUntil([&] { return robot.wanted.twist.linear.x == 0.0; }));
  robot.*input = true;
  EXPECT_TRUE(robot.runUntil(drives)) << "it goes on";
}

TEST(ExecutorNodelet, WaitsWhileOdometryIsSilent) {
  expectWaitsWithout(&MotionHarness::wheels, "odom",
                     std::regex("odometry is [0-9]+\\.[0-9]+ s old"));
}

TEST(ExecutorNodelet, WaitsWhileItsFrameIsSilent) {
  expectWaitsWithout(&MotionHarness::localised, "hall",
                     std::regex("from \"odom\" to \"hall\" is [0-9]+\\.[0-9]+ s old"));
}

TEST(ExecutorNodelet, WaitsWhileTheGateIsStoppedAndSaysSo) {
  MotionHarness robot;
  ASSERT_TRUE(robot.load("executor", "MotionExecutor"));
  robot.runUntil([&] { return robot.route_state.state == RouteState::IDLE; });
  EXPECT_TRUE(robot.runUntil([&] {
    if (robot.route_state.state == RouteState::IDLE ||
        robot.route_state.state == RouteState::REFUSED)  // before the first odometry
      robot.drive({{2.0, 0.0}}, "odom");
    robot.gate(StopState::STOPPED);
    return robot.route_state.state == RouteState::WAITING &&
           robot.route_state.text == "stop gate: pressed";
  })) << robot.route_state.text;
}

}  // namespace
}  // namespace pilothouse

int main(int argc, char** argv) {
  ros::init(argc, argv, "test_executor_nodelet");
  testing::InitGoogleTest(&argc, argv);
  ros::NodeHandle keeps_ros_alive;
  return RUN_ALL_TESTS();
}
