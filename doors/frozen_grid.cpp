#include "doors/frozen_grid.hpp"

#include <cmath>
#include <cstring>

namespace pilothouse {
namespace {

bool varies(const std::vector<float>& values) {
  float first = NAN;
  for (const float value : values) {
    if (std::isnan(value)) continue;
    if (std::isnan(first)) first = value;
    if (value != first) return true;
  }
  return false;
}

}  // namespace

bool FrozenGrid::repeats(const FloorGrid& grid) {
  const std::vector<float>& now = grid.deviations;
  const bool same = !now.empty() && now.size() == before_.size() &&
                    std::memcmp(now.data(), before_.data(), now.size() * sizeof(float)) == 0;
  if (!same) before_ = now;
  return same && varies(now);
}

}  // namespace pilothouse
