#pragma once

#include <vector>

#include "bench/limit_table.hpp"

namespace pilothouse::bench {

// What bench_maps times; a limit is in milliseconds.

/// The standard frame's floor grid and a scan of 640 beams into the occupancy map.
void addOccupancyCases(std::vector<TimedCase>& cases);

/// The standard frame into the octree, as the robot goes round, beside OctoMap's own insertion.
void addVolumeCases(std::vector<TimedCase>& cases);

/// Maps of 400^2, 1000^2 and 4000^2 cells taken and planned over from nothing, from corner to
/// corner, textbook Dijkstra beside; and planned over anew: something stands in the way, somebody
/// walks across it, a few cells of the map change.
void addPlanningCases(std::vector<TimedCase>& cases);
/// The planner's bars that are ratios.
void judgePlanning(LimitTable& table, const std::vector<TimedCase>& cases);

}  // namespace pilothouse::bench
