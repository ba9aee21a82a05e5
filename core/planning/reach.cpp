#include "core/planning/reach.hpp"

namespace pilothouse {

/// Row by row: slant steps need both cells beside, so they lead nowhere that straight ones do not.
void Reach::spread(const CostField& field, const Cell& from) {
  const std::vector<std::uint8_t>& weights = field.weights();
  const auto stride = static_cast<std::uint32_t>(field.stride());
  reached_.assign(weights.size(), 0);
  waiting_.clear();
  if (field.weight(from.x, from.y) != 0) waiting_.push_back(field.index(from.x, from.y));
  // The border of zeros ends every row, and the rows.
  while (!waiting_.empty()) {
    std::uint32_t cell = waiting_.back();
    waiting_.pop_back();
    if (reached_[cell] != 0) continue;
    while (weights[cell - 1] != 0 && reached_[cell - 1] == 0) --cell;
    bool above = false, below = false;
    for (; weights[cell] != 0 && reached_[cell] == 0; ++cell) {
      reached_[cell] = 1;
      const auto meet = [&](std::uint32_t beside, bool& along) {
        const bool open = weights[beside] != 0 && reached_[beside] == 0;
        if (open && !along) waiting_.push_back(beside);
        along = open;
      };
      meet(cell + stride, above);
      meet(cell - stride, below);
    }
  }
}

}  // namespace pilothouse
