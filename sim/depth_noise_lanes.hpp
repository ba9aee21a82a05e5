// Included once by each noise kernel: written so that the compiler makes vectors of it.
#include "sim/depth_noise_kernel.hpp"

namespace pilothouse::sim {
namespace {

/// A number that looks random for each pixel of each frame, whatever the order they are asked in
/// (two rounds of multiply and xorshift, the second with Wellons' "lowbias32" constants, 2018).
inline std::uint32_t scrambled(std::uint32_t pixel, std::uint32_t key_low, std::uint32_t key_high) {
  std::uint32_t x = (pixel ^ key_low) * 0x9E3779B1U;
  x = (x ^ (x >> 15U)) + key_high;
  x = (x ^ (x >> 16U)) * 0x7FEB352DU;
  x = (x ^ (x >> 15U)) * 0x846CA68BU;
  return x ^ (x >> 16U);
}

inline std::uint32_t scrambledAgain(std::uint32_t x) {
  x = (x ^ 0x68E31DA4U) * 0xB5297A4DU;
  return (x ^ (x >> 15U)) * 0x1B56C4E9U;
}

void measurePixels(const NoisePlan& plan, const float* depths, std::size_t count,
                   std::uint32_t first, std::uint16_t* millimetres) {
  constexpr std::uint32_t kFractionBits = 32 - kQuantileBits;
  constexpr float kFractionUnit = 1.0F / static_cast<float>(1U << kFractionBits);
  const NoisePlan p = plan;
  const bool rounded = p.steps_baseline > 0.0F;
  const float steps_baseline = rounded ? p.steps_baseline : 1.0F;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t x = scrambled(first + static_cast<std::uint32_t>(i), p.key_low, p.key_high);
    const std::uint32_t step = x >> kFractionBits;
    const float fraction =
        static_cast<float>(static_cast<std::int32_t>(x & ((1U << kFractionBits) - 1U))) *
        kFractionUnit;
    const float low = p.quantiles[step], high = p.quantiles[step + 1U];
    const float shift = low + fraction * (high - low);
    const bool lost = (scrambledAgain(x) >> 8U) < p.drop_out;

    const float z = depths[i];
    const float over = z - p.start;
    const float beyond = over > 0.0F ? over : 0.0F;
    const float noisy = z + (p.floor + p.slope * beyond * beyond) * shift;
    const bool kept = z > 0.0F && !lost && noisy >= p.nearest && noisy <= p.farthest;
    const float safe = kept ? noisy : 1.0F;
    const float disparity =
        static_cast<float>(static_cast<std::int32_t>(steps_baseline / safe + 0.5F));
    const float measured = rounded ? steps_baseline / disparity : safe;
    const auto whole = static_cast<std::int32_t>(measured * 1000.0F + 0.5F);
    millimetres[i] = static_cast<std::uint16_t>(kept ? whole : 0);
  }
}

}  // namespace
}  // namespace pilothouse::sim
