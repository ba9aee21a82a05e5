#include "core/motion/power_limit.hpp"

#include <algorithm>
#include <cmath>

namespace pilothouse {

double powerLimit(double distance, double n, double k) {
  if (!(distance > 0.0)) return 0.0;
  return std::min(1.0, k * (n == 1.0 ? distance : std::pow(distance, n)));
}

double brakingBound(double distance, double latency, double deceleration) {
  if (!(distance > 0.0)) return 0.0;
  // v latency + v^2 / (2 deceleration) = distance
  const double gone = deceleration * latency;
  return std::sqrt(gone * gone + 2.0 * deceleration * distance) - gone;
}

}  // namespace pilothouse
