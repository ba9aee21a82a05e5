#include "bench/floor_bars.hpp"

#include <algorithm>
#include <limits>

namespace pilothouse::bench {

void FloorTotals::add(const FloorResult& result) {
  ceiling.add(result.ceiling);
  original.add(result.original);
  improved.add(result.improved);
  doors_agree.add(result.doors_agree);
  if (!result.task.calibrating) return;
  ++calibrations;
  if (!result.mounting) {
    mountings_in_limits.count(false);
    return;
  }
  ++calibrations_found;
  worst_angle_deg = std::max(worst_angle_deg, result.mounting->angle_deg);
  worst_height = std::max(worst_height, result.mounting->height);
  mountings_in_limits.count(result.mounting->angle_deg <= 0.2 && result.mounting->height <= 0.005);
}

double percentOf(const Share& share) {
  return share.isKnown() ? share.percent() : std::numeric_limits<double>::quiet_NaN();
}

std::vector<Bar> barsOf(const FloorTotals& totals, bool calibrating) {
  const FloorScore& s = totals.improved;
  std::vector<Bar> bars = {
      {"iou", percentOf(s.iou), percentOf(totals.ceiling.iou) - 2.0},
      {"precision", percentOf(s.precision), 99.0},
      {"recall_18cm", percentOf(s.recall_18cm), 99.0},
      {"recall_7cm", percentOf(s.recall_7cm), 99.0},
      {"ramp_drivable", percentOf(s.ramp_drivable), 99.5},
      {"sill_drivable", percentOf(s.sill_drivable), 99.5},
      {"false_on_empty", percentOf(s.false_on_empty), 0.01, false},
      {"beyond_blocked", percentOf(s.beyond_blocked), 99.0},
  };
  if (calibrating)
    bars.push_back({"mountings_in_limits", percentOf(totals.mountings_in_limits), 100.0});
  return bars;
}

}  // namespace pilothouse::bench
