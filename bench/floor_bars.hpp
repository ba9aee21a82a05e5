#pragma once

#include <string>
#include <vector>

#include "bench/floor_trial.hpp"

namespace pilothouse::bench {

/// All scenes of one pass (true mounting known, or off and calibrating).
struct FloorTotals {
  FloorScore ceiling, original, improved;
  Share doors_agree;
  int calibrations = 0;        ///< scenes whose mounting was to be found
  int calibrations_found = 0;  ///< of these, found at all
  double worst_angle_deg = 0.0;
  double worst_height = 0.0;  ///< [m]
  Share mountings_in_limits;  ///< within 0.2 degrees and 5 mm
  void add(const FloorResult& result);
};

/// One figure against its limit.
struct Bar {
  std::string name;
  double value = 0.0;  ///< NaN where no scene gave one
  double limit = 0.0;
  bool at_least = true;
  bool isMet() const { return at_least ? value >= limit : value <= limit; }
};

/// Every bar that the improved method must meet. @param calibrating adds those of the mounting.
std::vector<Bar> barsOf(const FloorTotals& totals, bool calibrating);

/// Percent, NaN where nothing was counted.
double percentOf(const Share& share);

}  // namespace pilothouse::bench
