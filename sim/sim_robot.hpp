#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "core/motion/base_parameters.hpp"
#include "core/motion/footprint.hpp"

namespace pilothouse::sim {

/// An ultrasonic ranger on the robot.
struct SimRanger {
  std::string name;
  Eigen::Isometry3d T_base_ranger = Eigen::Isometry3d::Identity();  ///< x along the cone's middle
  double field_of_view = 0.5236;                                    ///< of the cone [rad]
  double min_range = 0.03, max_range = 3.0;                         ///< [m]
};

/// What the simulator must know of a robot.
struct SimRobot {
  std::string name;
  Footprint footprint;
  double height = 0.5;  ///< [m]
  BaseParameters base{};
  Eigen::Isometry3d T_base_camera = Eigen::Isometry3d::Identity();  ///< optical axes
  std::vector<SimRanger> rangers{};
};

}  // namespace pilothouse::sim
