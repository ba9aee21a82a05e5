#pragma once

#include <string>
#include <vector>

#include "bench/floor_trial.hpp"

namespace pilothouse::bench {

/// Draws depth, truth, ceiling, both methods and the improved method's faults on one sheet.
/// @param result of runTrial() with its pictures kept
/// @throws std::runtime_error where the file cannot be written.
void drawTrial(const FloorResult& result, const std::string& file);

}  // namespace pilothouse::bench
