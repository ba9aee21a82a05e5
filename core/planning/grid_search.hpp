#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/planning/bucket_queue.hpp"
#include "core/planning/cost_field.hpp"

namespace pilothouse {

/// A cell of a grid.
struct Cell {
  int x = 0, y = 0;

  bool operator==(const Cell& other) const { return x == other.x && y == other.y; }
};

/// Cheapest way over a cost field from cell to neighbouring cell, eight directions. A step of
/// length 1 or sqrt(2) between cells of weights a and b costs that length times (a + b) / 2;
/// slantwise only where both cells beside are free too.
///
/// A* (Hart, Nilsson and Raphael 1968) from the goal on whole numbers. What is found out is kept:
/// as long as the goal stays, a search after the start has moved or weights have changed takes up
/// only what that concerns, as D* Lite (Koenig and Likhachev 2002) does. Cells whose cost rested on
/// what changed are forgotten in the order of their costs (Ramalingam and Reps 1996), and found
/// anew from those round them. The cost, and the way, are those of a search from nothing.
class GridSearch {
 public:
  /// What one length of a cell at weight kPlain costs.
  static constexpr std::uint32_t kUnit = 70 * 2 * CostField::kPlain;
  static constexpr std::uint32_t kStraight = 70, kSlant = 99;  // 99 / 70 is sqrt(2) to 5e-5
  /// Ways that cost more are not found: 89 km of plain floor in cells of 5 cm.
  static constexpr std::uint32_t kDearest = 4000000000U;

  /// @param start, @param goal within the field; their weights must not be 0.
  /// @return the cost; nothing: there is no way.
  std::optional<std::uint32_t> find(const CostField& field, const Cell& start, const Cell& goal);
  /// The cells of the way that was found, both ends included.
  void trace(std::vector<Cell>& way) const;
  std::size_t expanded() const { return expanded_; }  ///< cells that the last search took up

 private:
  static constexpr std::uint32_t kFar = 0xffffffffU;
  using Entry = BucketQueue::Entry;

  bool knows(const CostField& field, const Cell& goal) const;
  void begin(const CostField& field, const Cell& goal);
  bool noteChanges(const CostField& field);
  bool mend();
  bool supported(std::uint32_t cell) const;
  void reopen(std::uint32_t cell, int x, int y);
  void order();
  void run();
  void expand(const Entry& entry);

  std::uint32_t index(int x, int y) const {
    return static_cast<std::uint32_t>(y + 1) * stride_ + static_cast<std::uint32_t>(x + 1);
  }
  std::uint32_t remaining(int x, int y) const;
  template <class Visit>
  void eachStep(std::uint32_t cell, Visit visit) const;

  std::uint32_t stride_ = 0;
  int size_x_ = 0, size_y_ = 0;
  Cell start_, goal_{-1, -1};
  std::vector<std::uint8_t> weights_;     ///< the field's, as the costs know them
  std::vector<std::uint64_t> revisions_;  ///< of the field's rows likewise
  std::vector<std::uint32_t> costs_;      ///< to the goal
  CellWindow taken_;         ///< where cells were taken up; costs lie at most one beside
  std::size_t entered_ = 0;  ///< cells since the search began
  std::size_t expanded_ = 0;
  BucketQueue open_, doubted_;
  std::vector<Entry> all_, dropped_;
  std::vector<Cell> changed_;
  std::vector<bool> seen_;
};

}  // namespace pilothouse
