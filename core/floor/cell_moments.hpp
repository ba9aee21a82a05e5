#pragma once

#include <cstdint>

namespace pilothouse {

/// Sums over the points of one cell. Heights are counted in whole steps (HeightScale), so the sums
/// are exact and do not depend on the order of the points or on the processor.
struct CellMoments {
  std::uint32_t count = 0;
  std::uint64_t sum = 0;         ///< of height steps
  std::uint64_t sum_square = 0;  ///< of squared height steps
};

/// Height in the base frame = low + steps * step, steps in 0..kMaxStep.
struct HeightScale {
  static constexpr int kMaxStep = 4095;
  float low = -0.6F;    ///< [m]; lower points count as this low
  float high = 1.6F;    ///< [m]; higher points are ignored, as are those above kMaxStep steps
  float step = 0.001F;  ///< [m]
};

}  // namespace pilothouse
