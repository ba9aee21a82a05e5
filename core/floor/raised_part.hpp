#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace pilothouse {

/// A cell read as two levels: floor, and some points raised above it (or sunk below it).
struct RaisedPart {
  float points = 0.0F;  ///< how many points are off the floor
  float height = 0.0F;  ///< how far they are off it [m], negative: below
};

/// From the moments of a cell alone: with k of n points at height H above the floor, the mean
/// excess is m = k H / n and the variance v = m (H - m), so H = m + v / m and k = n m / H.
/// @param points n; @param excess m, mean height less the floor's [m]; @param variance v, less what
/// the sensor's noise explains [m^2].
/// @param slack how far the floor's height may be wrong [m]: the excess is taken that much farther
///   from zero, so that the height found is a lower bound where few points are raised.
inline RaisedPart raisedPart(std::uint32_t points, float excess, float variance, float slack) {
  const float m = excess < 0.0F ? excess - slack : excess + slack;
  RaisedPart part;
  part.height = m + std::max(0.0F, variance) / m;
  part.points = static_cast<float>(points) * m / part.height;
  return part;
}

}  // namespace pilothouse
