#pragma once

#include <string>

namespace pilothouse::bench {

/// A bare floor, whose middle the robot circles, and one box that stands far off until it is
/// placed: the world of eval stop, as SDF.
std::string stopWorld();

/// Of the robot's circle [m]: so wide that what appears in its way, and the ground beside that,
/// lies in the camera's view. At its rim it would be remembered when it is gone, until the robot
/// turns.
constexpr double kStopWorldCircle = 3.2;
constexpr double kStopWorldHalf = 8.0;  ///< the floor reaches so far from 0 [m]
constexpr char kStopWorldBox[] = "obstacle";
constexpr double kStopWorldBoxEdge = 0.4;  ///< of its footprint [m]
constexpr double kStopWorldBoxAway = 6.5;  ///< where it waits, x and y [m]

}  // namespace pilothouse::bench
