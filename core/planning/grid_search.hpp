#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/planning/cost_field.hpp"

namespace pilothouse {

/// A cell of a grid.
struct Cell {
  int x = 0, y = 0;

  bool operator==(const Cell& other) const { return x == other.x && y == other.y; }
};

/// Cheapest way over a cost field from cell to neighbouring cell, eight directions: A* (Hart,
/// Nilsson and Raphael 1968) on whole numbers, with buckets for a queue (Dial 1969). A step of
/// length 1 or sqrt(2) between cells of weights a and b costs that length times (a + b) / 2;
/// slantwise only where both cells beside are free too. Cells that are entered again more cheaply
/// are taken again, so the cost is the least there is however wide the buckets are.
class GridSearch {
 public:
  /// What one length of a cell at weight kPlain costs.
  static constexpr std::uint32_t kUnit = 70 * 2 * CostField::kPlain;
  static constexpr std::uint32_t kStraight = 70, kSlant = 99;  // 99 / 70 is sqrt(2) to 5e-5

  /// @param start, @param goal within the field; their weights must not be 0.
  /// @return the cost; nothing: there is no way, and everything that can be reached was.
  std::optional<std::uint32_t> find(const CostField& field, const Cell& start, const Cell& goal);
  /// The cells of the way that was found, both ends included.
  void trace(const CostField& field, std::vector<Cell>& way) const;
  /// Whether the last search came there: after one without success, whether it can be reached.
  bool reached(const CostField& field, const Cell& cell) const {
    return costs_[field.index(cell.x, cell.y)] != kFar;
  }
  std::size_t expanded() const { return expanded_; }  ///< cells taken from the queue

 private:
  static constexpr std::uint32_t kFar = 0xffffffffU;
  static constexpr int kBucketBits = 11;  ///< a bucket is about one step over plain floor wide
  struct Entry {
    std::uint16_t x, y;
    std::uint32_t cost;
  };
  void prepare(const CostField& field);
  std::uint32_t remaining(int x, int y) const;
  void push(int x, int y, std::uint32_t cost);
  template <class Weights>
  void expand(const Weights& weights, const Entry& entry);

  std::vector<std::uint32_t> costs_;  ///< from the start, one a weight of the field
  std::vector<std::uint32_t> touched_;
  std::vector<std::vector<Entry>> buckets_;
  std::size_t waiting_ = 0, expanded_ = 0;
  std::uint32_t stride_ = 0;
  Cell start_, goal_;
};

}  // namespace pilothouse
