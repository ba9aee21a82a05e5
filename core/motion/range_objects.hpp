#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "core/motion/obstacle.hpp"

namespace pilothouse {

/// One echo of a range sensor with a cone.
struct RangeReading {
  double range = 0.0;                       ///< [m]; +infinity: nothing within max_range (REP 117)
  double field_of_view = 0.0;               ///< whole angle of the cone [rad], 0..pi
  double min_range = 0.0, max_range = 0.0;  ///< [m]
};

/// What an echo may be: any place on the cone's arc at that range, so all of it, in discs of
/// `piece` [m] that overlap (larger ones where 256 do not suffice). Nothing for an infinite range,
/// or one of max_range and beyond. A range below min_range (also -infinity, REP 117: too near to
/// measure) counts as an object at min_range.
/// @param T_base_ranger x along the cone's middle; what is level with the floor counts.
/// @param objects filled anew, base frame; at most 256 discs whatever the reading.
/// @return false when the reading means nothing (NaN, or limits that are none); objects is empty
/// then.
bool objectsOf(const RangeReading& reading, const Eigen::Isometry3d& T_base_ranger, double piece,
               std::vector<Obstacle>& objects);

}  // namespace pilothouse
