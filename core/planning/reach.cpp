#include "core/planning/reach.hpp"

#include <algorithm>

namespace pilothouse {

/// Row by row: slant steps need both cells beside, so they lead nowhere that straight ones do not.
bool Reach::spread(const CostField& field, const Cell& from, std::size_t most) {
  const std::vector<std::uint8_t>& weights = field.weights();
  const auto stride = static_cast<std::uint32_t>(field.stride());
  if (reached_.size() != weights.size()) {
    reached_.assign(weights.size(), 0);
  } else {
    std::fill(reached_.begin() + low_, reached_.begin() + high_, std::uint8_t{0});
  }
  waiting_.clear();
  count_ = 0;
  low_ = high_ = field.index(from.x, from.y);
  if (field.weight(from.x, from.y) != 0) waiting_.push_back(field.index(from.x, from.y));
  // The border of zeros ends every row, and the rows.
  while (!waiting_.empty()) {
    if (count_ >= most) return false;
    std::uint32_t cell = waiting_.back();
    waiting_.pop_back();
    if (reached_[cell] != 0) continue;
    while (weights[cell - 1] != 0 && reached_[cell - 1] == 0) --cell;
    low_ = std::min(low_, cell);
    bool above = false, below = false;
    for (; weights[cell] != 0 && reached_[cell] == 0; ++cell) {
      reached_[cell] = 1;
      ++count_;
      const auto meet = [&](std::uint32_t beside, bool& along) {
        const bool open = weights[beside] != 0 && reached_[beside] == 0;
        if (open && !along) waiting_.push_back(beside);
        along = open;
      };
      meet(cell + stride, above);
      meet(cell - stride, below);
    }
    high_ = std::max(high_, cell);
  }
  return true;
}

}  // namespace pilothouse
