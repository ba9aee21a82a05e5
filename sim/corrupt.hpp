#pragma once

#include <cstdint>
#include <vector>

#include "sim/readings.hpp"

namespace pilothouse::sim {

/// What a broken sensor or cable makes of a reading. Images get random bytes or lose their end;
/// numbers become NaN, infinite, or absurd.
void corrupt(std::shared_ptr<const DepthImage>& image, Random& random);
void corrupt(std::shared_ptr<const ColourImage>& image, Random& random);
void corrupt(OdometryReading& reading, Random& random);
void corrupt(ImuReading& reading, Random& random);
void corrupt(double& range, Random& random);

}  // namespace pilothouse::sim
