#include "sim/depth_noise_lanes.hpp"

namespace pilothouse::sim {

#ifdef __AVX2__  // set for this file alone where the processor is of this family
NoiseKernel avx2NoiseKernel() {
  return measurePixels;
}
#else
NoiseKernel avx2NoiseKernel() {
  return nullptr;
}
#endif

}  // namespace pilothouse::sim
