#pragma once

#include <cstdint>

#include "bench/pose_recording.hpp"
#include "doors/robot_description.hpp"

namespace pilothouse::bench {

/// What a simulated robot looks through.
enum class SimulatedScanner {
  kLaser,    ///< a level one of 360 beams, 30 cm high, 10 turns a second
  kLevel,    ///< the level scan that is made of a depth camera's points, 15 a second
  kVirtual,  ///< the scan that is made of the judged floor, 15 a second
};

/// Drives a robot round a random world with people in it, on a slippery floor: wheels that count
/// wrong, a gyroscope, a scanner. The route is known, the drive is steered by the true pose.
PoseRecording simulatePose(const RobotDescription& robot, std::uint64_t seed,
                           SimulatedScanner scanner);

/// The same round and round the furnished room that scripts/run shows, for three minutes, with the
/// simulator's own slip.
PoseRecording simulateTour(const RobotDescription& robot, std::uint64_t seed,
                           SimulatedScanner scanner);

/// The same drive where the wheels count their way and turns too large by a share, and without the
/// gyroscope.
PoseRecording slipping(PoseRecording recording, double share);

}  // namespace pilothouse::bench
