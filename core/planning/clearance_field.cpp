#include "core/planning/clearance_field.hpp"

#include <algorithm>

namespace pilothouse {

CellWindow CellWindow::grown(int by, int size_x, int size_y) const {
  if (empty()) return {};
  return {std::max(0, x0 - by), std::max(0, y0 - by), std::min(size_x, x1 + by),
          std::min(size_y, y1 + by)};
}

void CellWindow::include(int x, int y) {
  if (empty()) {
    *this = {x, y, x + 1, y + 1};
    return;
  }
  x0 = std::min(x0, x);
  y0 = std::min(y0, y);
  x1 = std::max(x1, x + 1);
  y1 = std::max(y1, y + 1);
}

void ClearanceField::resize(int size_x, int size_y, int reach) {
  size_x_ = size_x;
  size_y_ = size_y;
  reach_ = std::clamp(reach, 1, kMostReach);
  const auto cells = static_cast<std::size_t>(size_x) * static_cast<std::size_t>(size_y);
  squares_.assign(cells, most());
  beside_.assign(cells, static_cast<std::uint8_t>(reach_ + 1));
  padded_.assign(static_cast<std::size_t>(size_x + 2 * reach_), most());
  nearest_.assign(static_cast<std::size_t>(size_x), most());
}

CellWindow ClearanceField::update(const std::uint8_t* blocked, const CellWindow& changed) {
  const CellWindow write = changed.grown(reach_, size_x_, size_y_);
  const CellWindow read = write.grown(reach_, size_x_, size_y_);
  if (write.empty()) return write;
  sweepColumns(blocked, read, write);
  for (int y = write.y0; y < write.y1; ++y) sweepRow(y, read, write);
  return write;
}

/// Columns to the reach on both sides of what changed: their distances are summed up by the rows.
void ClearanceField::sweepColumns(const std::uint8_t* blocked, const CellWindow& read,
                                  const CellWindow& write) {
  const auto far = static_cast<std::uint8_t>(reach_ + 1);
  const auto width = static_cast<std::size_t>(read.x1 - read.x0);
  const auto take = [&](int y, int from) {
    const std::uint8_t* const is_blocked = blocked + index(read.x0, y);
    std::uint8_t* const out = beside_.data() + index(read.x0, y);
    const std::uint8_t* const before = beside_.data() + index(read.x0, from);
    for (std::size_t x = 0; x < width; ++x) {
      const auto next = static_cast<std::uint8_t>(before[x] + 1);
      const std::uint8_t least = next < far ? next : far;
      out[x] = is_blocked[x] != 0 ? std::uint8_t{0} : least;
    }
  };
  for (std::size_t x = 0; x < width; ++x) {
    beside_[index(read.x0, read.y0) + x] =
        blocked[index(read.x0, read.y0) + x] != 0 ? std::uint8_t{0} : far;
  }
  for (int y = read.y0 + 1; y < read.y1; ++y) take(y, y - 1);
  for (int y = read.y1 - 2; y >= write.y0; --y) {
    std::uint8_t* const out = beside_.data() + index(read.x0, y);
    const std::uint8_t* const before = beside_.data() + index(read.x0, y + 1);
    for (std::size_t x = 0; x < width; ++x) {
      const auto next = static_cast<std::uint8_t>(before[x] + 1);
      out[x] = next < out[x] ? next : out[x];
    }
  }
}

void ClearanceField::sweepRow(int y, const CellWindow& read, const CellWindow& write) {
  const auto left = static_cast<std::size_t>(write.x0 - read.x0);
  const auto width = static_cast<std::size_t>(write.x1 - write.x0);
  const auto span = static_cast<std::size_t>(read.x1 - read.x0);
  const auto reach = static_cast<std::size_t>(reach_);
  const std::uint8_t* const beside = beside_.data() + index(read.x0, y);
  std::int16_t* const padded = padded_.data() + reach;  // padded[i]: column read.x0 + i
  std::uint8_t least = static_cast<std::uint8_t>(reach_ + 1);
  for (std::size_t x = 0; x < span; ++x) {
    padded[x] = static_cast<std::int16_t>(beside[x] * beside[x]);
    least = std::min(least, beside[x]);
  }
  std::int16_t* const out = squares_.data() + index(write.x0, y);
  if (least > reach_) {
    std::fill(out, out + width, most());
    return;
  }
  std::fill(padded_.begin(), padded_.begin() + static_cast<std::ptrdiff_t>(reach), most());
  std::fill(padded + span, padded + span + reach, most());
  std::int16_t* const nearest = nearest_.data();
  std::copy(padded + left, padded + left + width, nearest);
  for (int d = 1; d <= reach_; ++d) {
    const auto square = static_cast<std::int16_t>(d * d);
    const std::int16_t* const before = padded + left - d;
    const std::int16_t* const after = padded + left + d;
    for (std::size_t x = 0; x < width; ++x) {
      const std::int16_t either = before[x] < after[x] ? before[x] : after[x];
      const auto sum = static_cast<std::int16_t>(either + square);
      nearest[x] = sum < nearest[x] ? sum : nearest[x];
    }
  }
  const std::int16_t cap = most();
  for (std::size_t x = 0; x < width; ++x) out[x] = nearest[x] < cap ? nearest[x] : cap;
}

}  // namespace pilothouse
