#pragma once

#include "core/motion/avoidance_parameters.hpp"

namespace pilothouse {

/// The original's power limit (KTU 2014, step 8) with its two parameters: P(d) = min(1, k d^n), the
/// share of the full speed at a free way d [m]; 0 for d <= 0.
double powerLimit(double distance, double n, double k);

/// Highest speed [m/s] from which the robot still stands within `distance` [m]: it goes on for
/// `latency` [s], then brakes with `deceleration` [m/s^2]. 0 for distance <= 0.
double brakingBound(double distance, double latency, double deceleration);

}  // namespace pilothouse
