// The robot's file as the console reads it.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "gui/model/robot_description.hpp"

using namespace pilothouse::gui;

namespace {

const char* const kRobot = R"(
name: platform
title: Four-wheel steered platform
base: four_wheel_steered
footprint: [[0.25, 0.20], [-0.25, 0.20], [-0.25, -0.20], [0.25, -0.20]]
height: 0.75
camera: {frame: c, x: 0.15, y: 0.0, z: 0.65, roll_deg: 0.0, pitch_deg: 26.0, yaw_deg: 90.0}
floor: {cell_size: 0.05}
)";

TEST(Robot, isRead) {
  const auto robot = parseRobot(kRobot);
  ASSERT_TRUE(robot) << robot.reason();
  EXPECT_EQ(robot->footprint.size(), 4U);
  EXPECT_DOUBLE_EQ(robot->footprint[2].x, -0.25);
  EXPECT_NEAR(robot->camera_yaw, M_PI / 2, 1e-12);
}

TEST(Robot, faultsNameKeyAndValue) {
  const auto reason = [](const std::string& from, const std::string& to) {
    std::string text = kRobot;
    text.replace(text.find(from), from.size(), to);
    const auto robot = parseRobot(text);
    return robot ? std::string("accepted") : robot.reason();
  };
  EXPECT_EQ(reason("height: 0.75", "height: tall"),
            "height: 'tall', expected a number from 0.01 to 5");
  EXPECT_EQ(reason("height: 0.75", "height: -1"), "height: '-1', expected a number from 0.01 to 5");
  EXPECT_EQ(reason("height: 0.75", "height: .nan"),
            "height: '.nan', expected a number from 0.01 to 5");
  EXPECT_EQ(reason("base: four_wheel_steered", "base: hover"),
            "base: 'hover', expected four_wheel_steered, differential or omnidirectional");
  EXPECT_EQ(reason("[0.25, 0.20], [-0.25, 0.20]", "[0.25], [-0.25, 0.20]"),
            "footprint[0]: a list, expected [x, y] in metres");
  EXPECT_EQ(reason("x: 0.15", "x: [1]"), "camera.x: a list, expected a number from -5 to 5");
  EXPECT_EQ(reason("title:", "titel:").substr(0, 26), "titel: not a known key, ex");
  EXPECT_EQ(reason("[[0.25, 0.20], [-0.25, 0.20]", "[[-0.25, 0.20], [0.25, 0.20]").substr(0, 9),
            "footprint");
  EXPECT_EQ(reason("name: platform", "name: [").substr(0, 8), "not YAML");
  EXPECT_EQ(readRobot("/nowhere/robot.yaml").reason(), "/nowhere/robot.yaml: cannot be read");
}

}  // namespace
