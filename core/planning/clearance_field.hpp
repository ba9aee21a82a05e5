#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pilothouse {

/// A part of a grid: columns [x0, x1), rows [y0, y1).
struct CellWindow {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

  bool empty() const { return x0 >= x1 || y0 >= y1; }
  /// Grown by `by` on every side, and cut to a grid of that size.
  CellWindow grown(int by, int size_x, int size_y) const;
  void include(int x, int y);
};

/// Squared distance from every cell's centre to the nearest blocked cell's [cells^2], exact up to a
/// reach. Columns first, then rows over no more than the reach (the separable scheme of Saito and
/// Toriwaki 1994): in 8 and 16 bit numbers that the compiler lays side by side.
class ClearanceField {
 public:
  static constexpr int kMostReach = 126;  ///< its squares still fit 16 bits

  /// Everything free. @param reach [cells], 1..kMostReach.
  void resize(int size_x, int size_y, int reach);
  int reach() const { return reach_; }
  /// What farther cells have.
  std::int16_t most() const { return static_cast<std::int16_t>((reach_ + 1) * (reach_ + 1)); }

  /// Takes `blocked` (1 or 0, size_x * size_y) anew where it changed.
  /// @return where squares may have changed.
  CellWindow update(const std::uint8_t* blocked, const CellWindow& changed);

  std::int16_t square(int x, int y) const { return squares_[index(x, y)]; }
  const std::int16_t* row(int y) const { return squares_.data() + index(0, y); }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size_x_) +
           static_cast<std::size_t>(x);
  }
  void sweepColumns(const std::uint8_t* blocked, const CellWindow& read, const CellWindow& write);
  void sweepRow(int y, const CellWindow& read, const CellWindow& write);

  int size_x_ = 0, size_y_ = 0, reach_ = 1;
  std::vector<std::int16_t> squares_;
  std::vector<std::uint8_t> beside_;   ///< distance to the nearest blocked cell of the column
  std::vector<std::int16_t> padded_;   ///< a row's squares with `reach_` far ones on both sides
  std::vector<std::int16_t> nearest_;  ///< a row being worked out
};

}  // namespace pilothouse
