#pragma once

#include <string>

#include "bench/pose_recording.hpp"
#include "core/cloud/checked.hpp"

namespace pilothouse::bench {

/// Reads a bag with scans and odometry (by tf or nav_msgs/Odometry), IMU and reference where it has
/// them: the reference is the topic whose name has ground_truth in it. The base is the frame right
/// below odometry's on the way to the scanner.
/// @return the recording, or what is missing.
Checked<PoseRecording> readPoseBag(const std::string& path);

}  // namespace pilothouse::bench
