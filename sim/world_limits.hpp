#pragma once

#include <cstddef>

namespace pilothouse::sim {

// Bounds on a world's file and on what it names.
constexpr std::size_t kMostFileBytes = std::size_t{64} << 20U;
constexpr std::size_t kMostElements = 100000;
constexpr std::size_t kMostTriangles = 100000;
constexpr std::size_t kMostTextures = 64;
constexpr double kFarthestPlace = 10000.0;  ///< coordinates and angles [m, rad]
constexpr double kThinnest = 0.0001;        ///< lengths [m]
constexpr double kLargest = 1000.0;         ///< lengths [m]

}  // namespace pilothouse::sim
