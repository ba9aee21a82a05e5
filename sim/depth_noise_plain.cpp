#include "sim/depth_noise_lanes.hpp"

namespace pilothouse::sim {

NoiseKernel plainNoiseKernel() {
  return measurePixels;
}

}  // namespace pilothouse::sim
