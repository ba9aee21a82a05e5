#include "core/floor/cell_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pilothouse {

namespace {

/// n sum(q^2) - sum(q)^2, n^2 times the variance: exact where it fits 64 bits, because the
/// difference of two large numbers would lose what it is after.
float spread(const CellMoments& m) {
  constexpr std::uint32_t kExact = 1U << 20;  // points whose squares of 12 bits each fit
  if (m.count <= kExact) return static_cast<float>(m.count * m.sum_square - m.sum * m.sum);
  const double n = m.count, sum = static_cast<double>(m.sum);
  return static_cast<float>(std::max(0.0, n * static_cast<double>(m.sum_square) - sum * sum));
}

}  // namespace

void fillStatistics(const std::vector<CellMoments>& moments, const HeightScale& scale,
                    int min_points, FloorCells& grid) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const auto fewest = static_cast<std::uint32_t>(min_points);
  for (std::size_t i = 0; i < moments.size(); ++i) {
    const CellMoments& m = moments[i];
    grid.counts[i] = m.count;
    if (m.count < fewest) {
      grid.classes[i] = CellClass::kUnknown;
      grid.heights[i] = grid.deviations[i] = kNan;
      continue;
    }
    const float inverse = 1.0F / static_cast<float>(m.count);
    const float mean = static_cast<float>(m.sum) * inverse;
    const float variance = spread(m) * inverse * inverse;
    grid.heights[i] = scale.low + scale.step * mean;
    grid.deviations[i] = scale.step * std::sqrt(variance);
    grid.classes[i] = CellClass::kFloor;
  }
}

}  // namespace pilothouse
