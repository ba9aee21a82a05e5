#pragma once

#include <string>

namespace pilothouse::bench {

/// A bare floor, and one box that stands far off until it is placed: the world of eval stop, as
/// SDF.
std::string stopWorld();

constexpr double kStopWorldHalf = 8.0;  ///< the floor reaches so far from 0 [m]
constexpr char kStopWorldBox[] = "obstacle";
constexpr double kStopWorldBoxEdge = 0.4;  ///< of its footprint [m]
constexpr double kStopWorldBoxAway = 6.5;  ///< where it waits, x and y [m]

}  // namespace pilothouse::bench
