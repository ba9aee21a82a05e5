#pragma once

#include <Eigen/Geometry>
#include <array>
#include <string>
#include <vector>

#include "core/cloud/checked.hpp"
#include "core/floor/floor_parameters.hpp"
#include "core/motion/avoidance_parameters.hpp"
#include "core/motion/base_parameters.hpp"
#include "core/motion/footprint.hpp"
#include "core/motion/object_merger.hpp"
#include "doors/strict_parameters.hpp"

namespace pilothouse {

/// Where a camera's body (x forward, y left, z up) sits on the robot.
struct CameraOnRobot {
  std::string frame;                 ///< optical frame of its pictures
  double x = 0.0, y = 0.0, z = 0.0;  ///< in base_link [m], -10..10
  double roll_deg = 0.0;             ///< positive leans right [deg], -180..180
  double pitch_deg = 0.0;            ///< positive looks down [deg], -90..90
  double yaw_deg = 0.0;              ///< positive looks left [deg], -180..180
};

/// An ultrasonic or infrared ranger that looks level. It publishes on range/NAME in frame
/// range_NAME.
struct RangerOnRobot {
  std::string name;                  ///< letters, digits and _
  double x = 0.0, y = 0.0, z = 0.0;  ///< in base_link [m], -10..10
  double yaw_deg = 0.0;              ///< positive looks left [deg], -180..180
  double field_of_view_deg = 30.0;   ///< of the cone [deg], 1..90
  double min_range = 0.03;           ///< [m], 0..max_range
  double max_range = 3.0;            ///< [m], 0.1..20
};

/// A robot's file in config/robots.
struct RobotDescription {
  std::string name, title;
  std::string base;  ///< four_wheel_steered, differential, omnidirectional
  std::vector<std::array<double, 2>> footprint;  ///< corners in base_link, counter-clockwise [m]
  double height = 0.0;                           ///< [m], 0.01..10
  CameraOnRobot camera;
  FloorParameters floor;
  BaseParameters drive;  ///< its kind is that of `base`
  std::vector<RangerOnRobot> rangers;
  AvoidanceParameters avoidance;

  Footprint outline() const;
};

/// Reads the namespace that a robot's file was loaded into; every key but floor, drive, rangers and
/// avoidance is required.
/// @throws ParameterFault naming each fault.
RobotDescription readRobot(StrictParameters& reader);
/// The same from the file itself, without a master; the reason begins with the file's name.
Checked<RobotDescription> readRobotFile(const std::string& path);

/// T_base_link: the pose of the camera's body.
Eigen::Isometry3d bodyPose(const CameraOnRobot& camera);
/// T_link_optical: from the optical axes (x right, y down, z forward) to the body's (REP 103).
Eigen::Isometry3d opticalRotation();
/// Name of the body's frame: that of the optical frame with _link for its ending.
std::string bodyFrame(const std::string& optical_frame);
/// T_base_ranger: x along the middle of its cone.
Eigen::Isometry3d rangerPose(const RangerOnRobot& ranger);
/// The robot's, as the merger wants them.
std::vector<ObjectMerger::Ranger> rangersOf(const RobotDescription& robot);

}  // namespace pilothouse
