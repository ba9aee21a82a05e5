#include "core/floor/cell_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pilothouse {

void fillStatistics(const std::vector<CellMoments>& moments, const HeightScale& scale,
                    int min_points, FloorGrid& grid) {
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
    const double inverse = 1.0 / m.count;
    const double mean = static_cast<double>(m.sum) * inverse;
    const double variance = static_cast<double>(m.sum_square) * inverse - mean * mean;
    grid.heights[i] = scale.low + scale.step * static_cast<float>(mean);
    grid.deviations[i] = scale.step * std::sqrt(std::max(0.0F, static_cast<float>(variance)));
    grid.classes[i] = CellClass::kFloor;
  }
}

}  // namespace pilothouse
