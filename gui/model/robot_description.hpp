#pragma once

#include <string>
#include <vector>

#include "core/cloud/checked.hpp"

namespace pilothouse::gui {

struct FootprintPoint {
  double x, y;  ///< base frame [m]
};

/// What the console knows of a robot, from config/robots/NAME.yaml.
struct RobotDescription {
  std::string name, title;
  std::string base;                       ///< four_wheel_steered, differential or omnidirectional
  std::vector<FootprintPoint> footprint;  ///< counter-clockwise, base frame
  double height = 0.0;                    ///< [m]
  std::string camera_frame;
  double camera_x = 0.0, camera_y = 0.0, camera_z = 0.0;  ///< base frame [m]
  double camera_yaw = 0.0;                                ///< [rad], 0: forward
};

/// Reads YAML text. Refuses, naming key, value and what was expected.
Checked<RobotDescription> parseRobot(const std::string& yaml);
/// The same from a file; the reason begins with the file's name.
Checked<RobotDescription> readRobot(const std::string& path);

}  // namespace pilothouse::gui
