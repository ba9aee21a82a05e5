#pragma once

#include "core/tasks/behaviour.hpp"

namespace pilothouse {

constexpr std::size_t kMostStops = 1000;
constexpr double kFarthestStop = 1e4;     // [m]
constexpr double kLongestPause = 3600.0;  // [s]

/// What is wrong with the stops of a wish, naming the stop, its value and what was expected; empty:
/// nothing.
std::string faultOfStops(const Wish& wish);

}  // namespace pilothouse
