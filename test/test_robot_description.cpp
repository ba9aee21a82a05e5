#include <gtest/gtest.h>

#include <fstream>

#include "doors/robot_description.hpp"
#include "test/own_folder.hpp"

namespace pilothouse {
namespace {

using XmlRpc::XmlRpcValue;

XmlRpcValue corners(std::initializer_list<std::array<double, 2>> points) {
  XmlRpcValue list;
  int i = 0;
  for (const auto& point : points) {
    list[i][0] = point[0];
    list[i][1] = point[1];
    ++i;
  }
  return list;
}

XmlRpcValue goodRobot() {
  XmlRpcValue robot;
  robot["name"] = "test";
  robot["title"] = "A robot";
  robot["base"] = "differential";
  robot["footprint"] = corners({{1.0, 1.0}, {-1.0, 1.0}, {-1.0, -1.0}, {1.0, -1.0}});
  robot["height"] = 1;
  XmlRpcValue& camera = robot["camera"];
  camera["frame"] = "camera_depth_optical_frame";
  camera["x"] = 0.1;
  camera["y"] = 0;
  camera["z"] = 0.65;
  camera["roll_deg"] = 0;
  camera["pitch_deg"] = 30.0;
  camera["yaw_deg"] = 0.0;
  return robot;
}

std::string faultOf(const XmlRpcValue& values) {
  StrictParameters reader("/robot", values);
  try {
    readRobot(reader);
  } catch (const ParameterFault& fault) {
    return fault.what();
  }
  return "";
}

TEST(RobotDescription, ReadsAGoodOne) {
  StrictParameters reader("/robot", goodRobot());
  const RobotDescription robot = readRobot(reader);
  EXPECT_EQ(robot.footprint.size(), 4U);
  EXPECT_EQ(robot.camera.z, 0.65);
}

TEST(RobotDescription, EveryKeyButFloorIsRequired) {
  for (const std::string key : {"name", "title", "base", "footprint", "height", "camera"}) {
    XmlRpcValue partial;
    for (auto& entry : goodRobot()) {
      if (entry.first != key) partial[entry.first] = entry.second;
    }
    EXPECT_EQ(faultOf(partial), "/robot: " + key + " is missing, expected to be set");
  }
  XmlRpcValue robot = goodRobot();
  robot["camera"] = XmlRpcValue();
  robot["camera"]["x"] = 0.0;
  EXPECT_NE(faultOf(robot).find("/robot/camera: z is missing"), std::string::npos);
}

TEST(RobotDescription, RefusesWhatIsNoFootprint) {
  XmlRpcValue robot = goodRobot();
  robot["footprint"] = corners({{1.0, 1.0}, {-1.0, 1.0}});
  EXPECT_NE(faultOf(robot).find("footprint is of 2 entries"), std::string::npos);
  robot["footprint"] = corners({{1.0, -1.0}, {-1.0, -1.0}, {-1.0, 1.0}, {1.0, 1.0}});
  EXPECT_NE(faultOf(robot).find("counter-clockwise"), std::string::npos) << "clockwise";
  robot["footprint"] = corners({{1.0, 1.0}, {-1.0, 1.0}, {-100.0, -1.0}});
  EXPECT_NE(faultOf(robot).find("footprint[2]"), std::string::npos);
  robot["footprint"][2] = "corner";
  EXPECT_NE(faultOf(robot).find("footprint[2] is \"corner\""), std::string::npos);
}

TEST(RobotDescription, RefusesUnknownKeysAndFloorParametersOutOfRange) {
  XmlRpcValue robot = goodRobot();
  robot["wheels"] = 4;
  EXPECT_NE(faultOf(robot).find("/robot: wheels is not a parameter"), std::string::npos);
  robot = goodRobot();
  robot["floor"]["cell_size"] = -1.0;
  EXPECT_NE(faultOf(robot).find("/robot/floor: cell_size is -1"), std::string::npos);
}

TEST(RobotDescription, ReadsTheFilesOfThePackage) {
  for (const std::string name : {"platform", "docker", "striker"}) {
    const auto robot = readRobotFile(PILOTHOUSE_SOURCE "/config/robots/" + name + ".yaml");
    ASSERT_TRUE(robot) << robot.reason();
    EXPECT_EQ(robot->name, name);
    EXPECT_GE(robot->outline().corners().size(), 4U);
  }
}

TEST(RobotDescription, AFileThatIsNoneIsRefusedByName) {
  EXPECT_EQ(readRobotFile("/nowhere/robot.yaml").reason(), "/nowhere/robot.yaml: cannot be read");
  const std::string path = ownFolder() + "/robot.yaml";
  std::ofstream(path) << "name: [";
  EXPECT_EQ(readRobotFile(path).reason().substr(0, path.size() + 10), path + ": not YAML");
  std::ofstream(path) << "name: 7\ncamera: {x: far}";
  const std::string reason = readRobotFile(path).reason();
  EXPECT_NE(reason.find(path + ": name is 7 (an int)"), std::string::npos) << reason;
  EXPECT_NE(reason.find(path + "/camera: x is \"far\""), std::string::npos) << reason;
}

TEST(RobotDescription, RefusesDrivesRangersAndAvoidanceOutOfRange) {
  XmlRpcValue robot = goodRobot();
  robot["drive"]["max_speed"] = 99.0;
  robot["avoidance"]["confirm_frames"] = 8;
  robot["rangers"][0]["name"] = "front left";
  const std::string faults = faultOf(robot);
  EXPECT_NE(
      faults.find("/robot/drive: max_speed is 99 (a double), expected a number from 0.01 to 10"),
      std::string::npos)
      << faults;
  EXPECT_NE(faults.find("avoidance: confirm_frames is 8, expected 1 to 3"), std::string::npos);
  EXPECT_NE(faults.find("/robot/rangers[0]: name is \"front left\""), std::string::npos);
  EXPECT_NE(faults.find("/robot/rangers[0]: x is missing"), std::string::npos);
}

TEST(RobotDescription, APitchedCameraLooksDown) {
  CameraOnRobot camera;
  camera.x = 0.1;
  camera.z = 0.65;
  camera.pitch_deg = 30.0;
  const Eigen::Isometry3d T_base_optical = bodyPose(camera) * opticalRotation();
  const Eigen::Vector3d ahead = T_base_optical * Eigen::Vector3d(0.0, 0.0, 1.0);
  EXPECT_NEAR(ahead.x(), 0.1 + std::cos(0.5235987755982988), 1e-12);
  EXPECT_NEAR(ahead.y(), 0.0, 1e-12);
  EXPECT_NEAR(ahead.z(), 0.65 - 0.5, 1e-12);
  const Eigen::Vector3d right = T_base_optical.linear() * Eigen::Vector3d::UnitX();
  EXPECT_NEAR((right - Eigen::Vector3d(0.0, -1.0, 0.0)).norm(), 0.0, 1e-12);
}

TEST(RobotDescription, APositiveRollLeansRight) {
  CameraOnRobot camera;
  camera.roll_deg = 10.0;
  const Eigen::Vector3d left = bodyPose(camera).linear() * Eigen::Vector3d::UnitY();
  EXPECT_GT(left.z(), 0.0) << "the left side goes up";
}

TEST(RobotDescription, NamesTheBodyAfterTheOpticalFrame) {
  EXPECT_EQ(bodyFrame("camera_depth_optical_frame"), "camera_link");
  EXPECT_EQ(bodyFrame("front_optical_frame"), "front_link");
  EXPECT_EQ(bodyFrame("eye"), "eye_link");
}

}  // namespace
}  // namespace pilothouse
