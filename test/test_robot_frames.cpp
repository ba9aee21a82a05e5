// The real RobotFrames nodelet on the robots' own files: the camera must be where the file says.
#include <gtest/gtest.h>
#include <tf2_ros/transform_listener.h>

#include "test/floor_harness.hpp"

namespace pilothouse {
namespace {

class RobotFrames : public testing::TestWithParam<std::string> {};

TEST_P(RobotFrames, PutsTheCameraWhereTheFileSays) {
  // The launch file loaded each robot's file below its name, with its own name for the frame.
  const std::string name = GetParam();
  ros::NodeHandle handle("/" + name);
  const std::string frame = name + "_depth_optical_frame";
  handle.setParam("robot/camera/frame", frame);
  nodelet::Loader loader(false);
  ASSERT_TRUE(loader.load("/" + name + "/frames", "pilothouse/RobotFrames", ros::M_string(),
                          nodelet::V_string()));
  tf2_ros::Buffer buffer;
  tf2_ros::TransformListener listener(buffer);
  ASSERT_TRUE(spinUntil([&] { return buffer.canTransform("base_link", frame, ros::Time(1234.5)); }))
      << "a static transform holds at any time";
  const Eigen::Isometry3d T_base_camera =
      tf2::transformToEigen(buffer.lookupTransform("base_link", frame, ros::Time(0)));
  double z = 0.0, pitch_deg = 0.0;
  ASSERT_TRUE(handle.getParam("robot/camera/z", z));
  ASSERT_TRUE(handle.getParam("robot/camera/pitch_deg", pitch_deg));
  EXPECT_NEAR(T_base_camera.translation().z(), z, 1e-9);
  const Eigen::Vector3d view = T_base_camera.linear() * Eigen::Vector3d::UnitZ();
  EXPECT_NEAR(-std::asin(view.z()) * 180.0 / 3.14159265358979323846, pitch_deg, 1e-6);
  EXPECT_GT(view.x(), 0.5) << "it looks ahead";
  EXPECT_TRUE(buffer.canTransform("base_link", name + "_link", ros::Time(0)));
}

TEST(RangerFrames, PutsTheRangersWhereTheFileSays) {
  nodelet::Loader loader(false);
  ASSERT_TRUE(loader.load("/platform/rangers", "pilothouse/RobotFrames", ros::M_string(),
                          nodelet::V_string()));
  tf2_ros::Buffer buffer;
  tf2_ros::TransformListener listener(buffer);
  ASSERT_TRUE(
      spinUntil([&] { return buffer.canTransform("base_link", "range_rear", ros::Time(0)); }));
  const Eigen::Isometry3d T_base_rear =
      tf2::transformToEigen(buffer.lookupTransform("base_link", "range_rear", ros::Time(0)));
  EXPECT_TRUE(T_base_rear.translation().isApprox(Eigen::Vector3d(-0.25, 0.0, 0.2)));
  EXPECT_NEAR(T_base_rear.linear()(0, 0), -1.0, 1e-9) << "it looks back";
}

INSTANTIATE_TEST_SUITE_P(EachRobot, RobotFrames, testing::Values("platform", "docker", "striker"),
                         [](const auto& info) { return info.param; });

}  // namespace
}  // namespace pilothouse

int main(int argc, char** argv) {
  ros::init(argc, argv, "test_robot_frames");
  testing::InitGoogleTest(&argc, argv);
  ros::NodeHandle keeps_ros_alive;
  return RUN_ALL_TESTS();
}
