#pragma once

#include <pilothouse/FloorConfig.h>

#include "core/floor/floor_parameters.hpp"
#include "nodelets/strict_parameters.hpp"

namespace pilothouse {

/// Reads every key of FloorParameters; where one is missing the value in `parameters` stays.
/// Faults of types are the reader's, those of ranges come from validate().
void readFloorParameters(StrictParameters& reader, FloorParameters& parameters);

FloorConfig toConfig(const FloorParameters& parameters);
/// @throws std::invalid_argument for a method that is neither original nor improved.
FloorParameters fromConfig(const FloorConfig& config);

}  // namespace pilothouse
