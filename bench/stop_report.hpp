#pragma once

#include <string>
#include <vector>

#include "bench/stop_trial.hpp"

namespace pilothouse::bench {

/// A value that so much of them do not exceed: 0..1 of the sorted ones; NaN where there are none,
/// and where one is NaN it counts as the largest.
double quantile(std::vector<double> values, double share);

std::string jsonOf(const StopResult& result, int number);
std::string jsonOf(const AppearanceResult& result, int number);
/// One line for each kind of fault.
std::vector<std::string> jsonByKind(const std::vector<StopResult>& results);

/// The last line, and whether every bar is met.
struct StopSummary {
  std::string json;
  bool pass = false;
};
StopSummary summaryOf(const std::vector<StopResult>& faults,
                      const std::vector<AppearanceResult>& appearances, int false_stops);

/// A strip of dots for each kind of fault, and one for the obstacles, as PNG.
/// @throws std::runtime_error when it cannot be written.
void drawStops(const std::vector<StopResult>& faults,
               const std::vector<AppearanceResult>& appearances, const std::string& file);

}  // namespace pilothouse::bench
