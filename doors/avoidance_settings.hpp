#pragma once

#include <pilothouse/AvoidanceConfig.h>

#include "core/motion/avoidance_parameters.hpp"
#include "doors/strict_parameters.hpp"

namespace pilothouse {

/// Reads every key of AvoidanceParameters within its range (config/Avoidance.cfg has the same, a
/// test holds that); where one is missing the value in `parameters` stays. Combinations that are
/// wrong together are faults too.
void readAvoidanceParameters(StrictParameters& reader, AvoidanceParameters& parameters);

AvoidanceConfig toConfig(const AvoidanceParameters& parameters);
AvoidanceParameters fromConfig(const AvoidanceConfig& config);

}  // namespace pilothouse
