#pragma once

#include <ostream>
#include <vector>

#include "bench/interleaved_timing.hpp"

namespace pilothouse::bench {

// What bench_maps times; a limit is in milliseconds.

/// The standard frame's floor grid and a scan of 640 beams into the occupancy map.
void addOccupancyCases(std::vector<TimedCase>& cases);

/// The standard frame into the octree, as the robot goes round, beside OctoMap's own insertion.
void addVolumeCases(std::vector<TimedCase>& cases);

/// Maps of 400^2, 1000^2 and 4000^2 cells taken and planned over from corner to corner, a way that
/// is blocked planned anew, and textbook Dijkstra beside.
void addPlanningCases(std::vector<TimedCase>& cases);
/// The planner's bars, which are ratios. Prints and writes a line each.
/// @return whether all are met.
bool judgePlanning(std::ostream& out, const std::vector<TimedCase>& cases);

}  // namespace pilothouse::bench
