#pragma once

#include <cstddef>
#include <cstdint>

// What the noise kernels share. Only plain data, so that a file compiled for a newer processor
// shares no inline function with the rest of the program.

namespace pilothouse::sim {

constexpr int kQuantileBits = 10;  ///< the normal distribution's quantiles are tabled in 2^10 steps

/// One frame's arithmetic of DepthNoise in single precision.
struct NoisePlan {
  float floor, slope, start;
  float steps_baseline;             ///< disparity steps * focal length * baseline; 0: not rounded
  float nearest, farthest;          ///< [m]
  std::uint32_t drop_out;           ///< share of lost pixels in 1/2^24
  std::uint32_t key_low, key_high;  ///< of the seed and frame
  const float* quantiles;           ///< 2^kQuantileBits + 1 values
};

/// Measures `count` pixels, the first of which has number `first` in its picture.
using NoiseKernel = void (*)(const NoisePlan& plan, const float* depths, std::size_t count,
                             std::uint32_t first, std::uint16_t* millimetres);
NoiseKernel plainNoiseKernel();
/// nullptr where it is not built.
NoiseKernel avx2NoiseKernel();

}  // namespace pilothouse::sim
