// The Simulator nodelet with a clock of its own, as fast as possible.
#include <geometry_msgs/Twist.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <rosgraph_msgs/Clock.h>

#include "test/floor_harness.hpp"

namespace pilothouse {
namespace {

TEST(SimulatorClock, GivesEverybodyItsTime) {
  ros::NodeHandle handle("/platform");
  Inbox<rosgraph_msgs::Clock> clock(handle, "/clock");
  Inbox<nav_msgs::Odometry> odometry(handle, "odom");
  const ros::Publisher commands = handle.advertise<geometry_msgs::Twist>("cmd_vel", 1);
  nodelet::Loader loader(false);
  ASSERT_TRUE(loader.load("/platform/simulator", "pilothouse/Simulator", ros::M_string(),
                          nodelet::V_string()));
  ASSERT_TRUE(odometry.waitFor(1) && clock.waitFor(1));
  EXPECT_LT(odometry.all()[0]->header.stamp, ros::Time(1e6)) << "simulated, not wall time";
  EXPECT_GE(odometry.all()[0]->header.stamp, ros::Time(1.0));
  // Simulated time runs ahead of the wall's, over one stretch at least: a busy computer slows
  // others.
  ros::Time from = ros::Time::now();
  ros::WallTime wall_from = ros::WallTime::now();
  EXPECT_TRUE(spinUntil(
      [&] {
        const double simulated = (ros::Time::now() - from).toSec();
        if (simulated < 4.0) return false;
        if (simulated > 1.2 * (ros::WallTime::now() - wall_from).toSec()) return true;
        from = ros::Time::now();
        wall_from = ros::WallTime::now();
        return false;
      },
      120.0));
  // A single command lasts for the base's timeout in simulated time.
  ASSERT_TRUE(spinUntil([&] { return commands.getNumSubscribers() > 0; }));
  geometry_msgs::Twist twist;
  twist.linear.x = 0.5;
  commands.publish(twist);
  const auto newest = [&] { return odometry.all().back(); };
  EXPECT_TRUE(spinUntil([&] { return newest()->pose.pose.position.x > 0.005; }));
  EXPECT_TRUE(spinUntil([&] { return newest()->twist.twist.linear.x == 0.0; }));
  // Speeding up at 0.6 m/s^2 for 0.3 s, then braking.
  EXPECT_GT(newest()->pose.pose.position.x, 0.02);
  EXPECT_LT(newest()->pose.pose.position.x, 0.1);
  for (std::size_t i = 1; i < odometry.all().size(); ++i) {
    ASSERT_GT(odometry.all()[i]->header.stamp, odometry.all()[i - 1]->header.stamp);
  }
}

}  // namespace
}  // namespace pilothouse

int main(int argc, char** argv) {
  ros::init(argc, argv, "test_simulator_clock");
  testing::InitGoogleTest(&argc, argv);
  ros::NodeHandle keeps_ros_alive;
  return RUN_ALL_TESTS();
}
