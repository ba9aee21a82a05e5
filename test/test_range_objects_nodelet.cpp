// The real nodelet range objects in this process, fed by hand.
#include <gtest/gtest.h>

#include "test/motion_harness.hpp"

namespace pilothouse {
namespace {

TEST(RangeObjectsNodelet, CountsAReadingThatMeansNothingAndGivesNothingForIt) {
  MotionHarness robot;
  ASSERT_TRUE(robot.load("range_objects", "RangeObjects"));
  robot.front = 1.0F;
  ASSERT_TRUE(robot.runUntil([&] { return !robot.echoes.objects.empty(); }));
  EXPECT_EQ(robot.echoes.source, "front");
  EXPECT_EQ(robot.echoes.header.frame_id, "base_link");
  robot.front = std::numeric_limits<float>::quiet_NaN();
  ASSERT_TRUE(robot.runUntil(
      [&] { return robot.said("range_objects", "front", "rejected: message") != ""; }));
  EXPECT_EQ(robot.said("range_objects", "front", "last rejection"),
            "range is nan, expected a number");
}

}  // namespace
}  // namespace pilothouse

int main(int argc, char** argv) {
  ros::init(argc, argv, "test_range_objects_nodelet");
  testing::InitGoogleTest(&argc, argv);
  ros::NodeHandle keeps_ros_alive;
  return RUN_ALL_TESTS();
}
