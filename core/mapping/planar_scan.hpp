#pragma once

#include <cstddef>

#include "core/motion/planar.hpp"

namespace pilothouse {

/// One turn of a laser, or of what stands for one, after REP 117. Borrows its ranges.
struct PlanarScan {
  Pose2 T_base_scan;              ///< the sensor on the base
  double angle_min = 0.0;         ///< of the first beam, in the sensor's frame [rad]
  double increment = 0.0;         ///< from beam to beam [rad]
  double range_min = 0.0;         ///< less is no measurement [m]
  double range_max = 0.0;         ///< more, and +infinity, mean that nothing came back [m]
  const float* ranges = nullptr;  ///< [m]; NaN and -infinity: nothing is known, nothing is cleared
  std::size_t count = 0;
};

/// What one beam says.
struct BeamMeaning {
  double free_until = 0.0;  ///< of the beam [m]; 0: it says nothing
  bool hit = false;         ///< something is at free_until
};

/// @param clear_range a beam without a return clears no farther; @param reach nor does any, and
/// what is farther is no hit [m].
inline BeamMeaning meaningOf(const PlanarScan& scan, double range, double clear_range,
                             double reach) {
  if (std::isnan(range) || range < scan.range_min || !(range > 0.0)) return {};
  const bool returned = range <= scan.range_max;
  if (!returned) return {std::fmin(std::fmin(clear_range, scan.range_max), reach), false};
  return range <= reach ? BeamMeaning{range, true} : BeamMeaning{reach, false};
}

}  // namespace pilothouse
