#pragma once

#include <cstdint>
#include <vector>

#include "sim/random.hpp"

namespace pilothouse::sim {

/// How a Kinect spoils a depth image: normal noise of sigma(z) = floor + slope (z - start)^2 (after
/// Nguyen, Izadi and Lovell 2012, "Modeling Kinect sensor noise"), then disparity rounded to whole
/// steps, then pixels lost at random and everything out of range lost.
struct DepthNoise {
  double floor = 0.0012;                  ///< [m]
  double slope = 0.0019;                  ///< [1/m]
  double start = 0.4;                     ///< nearer depths have the floor alone [m]
  double focal_baseline = 525.0 * 0.075;  ///< disparity = this / depth [pixel m]
  double disparity_steps = 8.0;           ///< a pixel
  double drop_out = 0.01;                 ///< share of pixels without a measurement
  double nearest = 0.5;                   ///< [m]
  double farthest = 8.0;                  ///< [m]

  double sigma(double depth) const;
  /// One measurement of `depth` [m]; 0 where it is lost.
  double measure(double depth, Random& random) const;
};

/// The 16UC1 image [mm] (0: no measurement) that a real camera gives for perfect `depths` [m].
/// Draws the same random numbers a pixel whatever the depth. Reuses the memory of `image`.
void measure(const std::vector<float>& depths, const DepthNoise& noise, Random& random,
             std::vector<std::uint16_t>& image);

}  // namespace pilothouse::sim
