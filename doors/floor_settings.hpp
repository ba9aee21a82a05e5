#pragma once

#include <pilothouse/FloorConfig.h>

#include "core/floor/floor_parameters.hpp"
#include "doors/strict_parameters.hpp"

namespace pilothouse {

/// Reads every key of FloorParameters, each within the range of config/Floor.cfg (a test holds that
/// to validate()); where one is missing the value in `parameters` stays. Combinations that are
/// wrong together are faults too.
void readFloorParameters(StrictParameters& reader, FloorParameters& parameters);

FloorConfig toConfig(const FloorParameters& parameters);
/// @throws std::invalid_argument for a method that is neither original nor improved.
FloorParameters fromConfig(const FloorConfig& config);

}  // namespace pilothouse
