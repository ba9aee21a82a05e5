#pragma once

#include <vector>

#include "bench/interleaved_timing.hpp"

namespace pilothouse::bench {

// What bench_maps times; a limit is in milliseconds.

/// The standard frame's floor grid and a scan of 640 beams into the occupancy map.
void addOccupancyCases(std::vector<TimedCase>& cases);

}  // namespace pilothouse::bench
