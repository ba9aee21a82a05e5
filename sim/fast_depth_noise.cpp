#include "sim/fast_depth_noise.hpp"

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "sim/depth_noise_kernel.hpp"

namespace pilothouse::sim {
namespace {

constexpr std::size_t kQuantiles = (std::size_t{1} << kQuantileBits) + 1;

/// Quantile of the standard normal distribution, by bisection of its distribution function.
double normalQuantile(double probability) {
  double low = -8.0, high = 8.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2.0;
    (0.5 * std::erfc(-middle * M_SQRT1_2) < probability ? low : high) = middle;
  }
  return low;
}

/// At the ends, where the distribution has none, a value that gives the last step its variance.
std::array<float, kQuantiles> makeQuantiles() {
  std::array<float, kQuantiles> table{};
  const double steps = static_cast<double>(kQuantiles - 1);
  for (std::size_t i = 1; i + 1 < kQuantiles; ++i)
    table[i] = static_cast<float>(normalQuantile(static_cast<double>(i) / steps));
  table[0] = static_cast<float>(normalQuantile(0.05 / steps));
  table[kQuantiles - 1] = -table[0];
  return table;
}

NoisePlan makePlan(const DepthNoise& noise, std::uint64_t seed, std::uint64_t frame) {
  static const std::array<float, kQuantiles> quantiles = makeQuantiles();
  const std::uint64_t key = mixSeed(seed, frame);
  NoisePlan plan{};
  plan.floor = static_cast<float>(noise.floor);
  plan.slope = static_cast<float>(noise.slope);
  plan.start = static_cast<float>(noise.start);
  plan.steps_baseline = static_cast<float>(noise.disparity_steps * noise.focal_baseline);
  plan.nearest = static_cast<float>(noise.nearest);
  plan.farthest = static_cast<float>(noise.farthest);
  plan.drop_out = static_cast<std::uint32_t>(noise.drop_out * 0x1p24 + 0.5);
  plan.key_low = static_cast<std::uint32_t>(key);
  plan.key_high = static_cast<std::uint32_t>(key >> 32U);
  plan.quantiles = quantiles.data();
  return plan;
}

NoiseKernel fastestKernel() {
#if defined(__x86_64__) || defined(__i386__)
  if (avx2NoiseKernel() != nullptr && __builtin_cpu_supports("avx2")) return avx2NoiseKernel();
#endif
  return plainNoiseKernel();
}

}  // namespace

FastDepthNoise::FastDepthNoise(const DepthNoise& noise) : noise_(noise) {
  if (!(noise.farthest < 65.5 && noise.nearest > 0.0 && noise.nearest < noise.farthest)) {
    throw std::invalid_argument("depth range is " + std::to_string(noise.nearest) + " to " +
                                std::to_string(noise.farthest) +
                                " m, expected within 0 (excluded) to 65.5");
  }
}

void FastDepthNoise::measure(const float* depths, std::size_t count, std::uint64_t seed,
                             std::uint64_t frame, std::uint16_t* millimetres) const {
  static const NoiseKernel kernel = fastestKernel();
  kernel(makePlan(noise_, seed, frame), depths, count, 0, millimetres);
}

void FastDepthNoise::measurePlain(const float* depths, std::size_t count, std::uint64_t seed,
                                  std::uint64_t frame, std::uint16_t* millimetres) const {
  plainNoiseKernel()(makePlan(noise_, seed, frame), depths, count, 0, millimetres);
}

}  // namespace pilothouse::sim
