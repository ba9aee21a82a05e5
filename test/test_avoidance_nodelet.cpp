// The real nodelet avoidance in this process, fed by hand.
#include <gtest/gtest.h>

#include "test/motion_harness.hpp"

namespace pilothouse {
namespace {

TEST(Avoidance, LetsThroughWhatIsFreeWithTheStampOfTheOriginal) {
  MotionHarness robot;
  ASSERT_TRUE(robot.load("avoidance", "Avoidance"));
  robot.task = 0.3;
  // Both of one step: they come one after the other.
  ASSERT_TRUE(robot.runUntil([&] {
    return robot.limited.twist.linear.x > 0.2 && robot.limit.cause == SpeedLimit::FREE &&
           robot.limited.header.stamp == robot.limit.command_stamp;
  }));
  EXPECT_EQ(robot.limit.source, "task");
  EXPECT_LE((robot.limit.header.stamp - robot.limit.perception_stamp).toSec(), 0.3);
}

TEST(Avoidance, APersonWinsOverATask) {
  MotionHarness robot;
  ASSERT_TRUE(robot.load("avoidance", "Avoidance"));
  robot.task = 0.3;
  robot.teleop = -0.05;
  ASSERT_TRUE(robot.runUntil([&] { return robot.limit.source == "teleop"; }));
  robot.teleop = 0.0;  // the key is let go, its last wish grows old
  EXPECT_TRUE(robot.runUntil([&] { return robot.limit.source == "task"; }));
}

TEST(Avoidance, StandsBeforeAnEchoAndSaysWhichSensorAndHowFar) {
  MotionHarness robot;
  ASSERT_TRUE(robot.load("avoidance", "Avoidance"));
  robot.task = 0.3;
  robot.front = 0.2F;
  // Until its first echo it is "front" that is silent.
  ASSERT_TRUE(robot.runUntil(
      [&] { return robot.limit.sensor == "front" && robot.limit.cause != SpeedLimit::STALE; }));
  EXPECT_TRUE(robot.limit.cause == SpeedLimit::OBSTACLE ||
              robot.limit.cause == SpeedLimit::BRAKING);
  EXPECT_EQ(robot.limit.limit, 0.0F);
  EXPECT_EQ(robot.limited.twist.linear.x, 0.0);
  EXPECT_NEAR(robot.limit.distance, 0.2F, 0.06F);
  ASSERT_TRUE(robot.runUntil([&] { return !robot.objects.objects.empty(); }));
  EXPECT_EQ(robot.objects.sources.size(), 3U);
  robot.front = std::numeric_limits<float>::infinity();
  EXPECT_TRUE(robot.runUntil([&] { return robot.limited.twist.linear.x > 0.1; })) << "goes on";
}

TEST(Avoidance, StandsWhenTheCameraIsSilentAndNamesIt) {
  MotionHarness robot;
  ASSERT_TRUE(robot.load("avoidance", "Avoidance"));
  robot.task = 0.3;
  ASSERT_TRUE(robot.runUntil([&] { return robot.limited.twist.linear.x > 0.1; }));
  robot.camera = false;
  ASSERT_TRUE(robot.runUntil(
      [&] { return robot.limit.cause == SpeedLimit::STALE && robot.limit.sensor == "camera"; }));
  EXPECT_EQ(robot.limited.twist.linear.x, 0.0);
}

TEST(Avoidance, RefusesOdometryOfAnotherFrameOrBodyAndCountsIt) {
  const auto refuses = [](std::string MotionHarness::*frame, const std::string& words) {
    MotionHarness robot;
    ASSERT_TRUE(robot.load("avoidance", "Avoidance"));
    robot.task = 0.3;
    ASSERT_TRUE(robot.runUntil([&] { return robot.limited.twist.linear.x > 0.1; }));
    robot.*frame = "map";
    ASSERT_TRUE(robot.runUntil([&] {
      return robot.limit.cause == SpeedLimit::STALE && robot.limit.sensor == "odometry" &&
             robot.said("avoidance", "odom", "rejected: message") != "";
    })) << words;
    EXPECT_EQ(robot.limited.twist.linear.x, 0.0);
    EXPECT_EQ(robot.said("avoidance", "odom", "last rejection"), words);
  };
  refuses(&MotionHarness::odom_frame,
          "of \"base_link\" in \"map\", expected of \"base_link\" in \"odom\"");
  refuses(&MotionHarness::base_frame,
          "of \"map\" in \"odom\", expected of \"base_link\" in \"odom\"");
}

TEST(Avoidance, StaysAtZeroWhileTheGateIsStopped) {
  MotionHarness robot;
  ASSERT_TRUE(robot.load("avoidance", "Avoidance"));
  ASSERT_TRUE(robot.runUntil([&] {
    robot.gate(StopState::STOPPED);
    return robot.gateHeard();
  }));
  robot.gate(StopState::STOPPED);
  robot.task = 0.4;
  double fastest = 0.0;
  int wanting = 0;  // a second of that would have brought it to 0.4 m/s
  ASSERT_TRUE(robot.runUntil([&] {
    robot.gate(StopState::STOPPED);
    fastest = std::max(fastest, robot.limited.twist.linear.x);
    if (robot.limit.wanted > 0.3F) ++wanting;
    return wanting > 50;
  }));
  EXPECT_LT(fastest, 0.05);
  EXPECT_TRUE(robot.runUntil([&] {
    robot.gate(StopState::IDLE);
    return robot.limited.twist.linear.x > 0.3;
  }));
}

}  // namespace
}  // namespace pilothouse

int main(int argc, char** argv) {
  ros::init(argc, argv, "test_avoidance_nodelet");
  testing::InitGoogleTest(&argc, argv);
  ros::NodeHandle keeps_ros_alive;
  return RUN_ALL_TESTS();
}
