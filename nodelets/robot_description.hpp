#pragma once

#include <Eigen/Geometry>
#include <array>
#include <string>
#include <vector>

#include "core/floor/floor_parameters.hpp"
#include "nodelets/strict_parameters.hpp"

namespace pilothouse {

/// Where a camera's body (x forward, y left, z up) sits on the robot.
struct CameraOnRobot {
  std::string frame;                 ///< optical frame of its pictures
  double x = 0.0, y = 0.0, z = 0.0;  ///< in base_link [m], -10..10
  double roll_deg = 0.0;             ///< positive leans right [deg], -180..180
  double pitch_deg = 0.0;            ///< positive looks down [deg], -90..90
  double yaw_deg = 0.0;              ///< positive looks left [deg], -180..180
};

/// A robot's file in config/robots.
struct RobotDescription {
  std::string name, title;
  std::string base;  ///< four_wheel_steered, differential, omnidirectional
  std::vector<std::array<double, 2>> footprint;  ///< corners in base_link, counter-clockwise [m]
  double height = 0.0;                           ///< [m], 0.01..10
  CameraOnRobot camera;
  FloorParameters floor;
};

/// Reads the namespace that a robot's file was loaded into; every key but floor is required.
/// @throws ParameterFault naming each fault.
RobotDescription readRobot(StrictParameters& reader);

/// T_base_link: the pose of the camera's body.
Eigen::Isometry3d bodyPose(const CameraOnRobot& camera);
/// T_link_optical: from the optical axes (x right, y down, z forward) to the body's (REP 103).
Eigen::Isometry3d opticalRotation();
/// Name of the body's frame: that of the optical frame with _link for its ending.
std::string bodyFrame(const std::string& optical_frame);

}  // namespace pilothouse
