#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/pose/scan_points.hpp"

namespace pilothouse::bench {

using StampedPose = std::pair<double, Pose2>;  ///< stamp [s], pose in some frame fixed to the floor

struct OdometryEvent {
  double stamp;
  Pose2 T_odom_base;
};
struct GyroEvent {
  double stamp;
  double rate;  ///< about the vertical axis [rad/s]
};
struct ScanEvent {
  std::size_t source;  ///< index into PoseRecording::scan_names
  ScanBeams beams;
  ScanMounting mounting;
};

/// What a robot drove and saw, in the order in which it arrived, and where it really was.
struct PoseRecording {
  std::vector<std::variant<OdometryEvent, GyroEvent, ScanEvent>> events;
  std::vector<std::string> scan_names;
  std::vector<StampedPose> reference;  ///< stamps rising; empty: none
  std::string odometry, gyro;          ///< where they came from; empty: none
  std::string reference_name;
  std::vector<std::string> notes;  ///< what was left out and why
};

}  // namespace pilothouse::bench
