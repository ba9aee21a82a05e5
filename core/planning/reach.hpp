#pragma once

#include <cstdint>
#include <vector>

#include "core/planning/grid_search.hpp"

namespace pilothouse {

/// The cells of a cost field that can be reached from one of them.
class Reach {
 public:
  static constexpr std::size_t kAll = ~std::size_t{0};

  /// @param from within the field; reaches nothing where its weight is 0.
  /// @param most about so many cells are looked at. @return whether that was all.
  bool spread(const CostField& field, const Cell& from, std::size_t most = kAll);
  std::size_t count() const { return count_; }  ///< of cells reached
  bool holds(const CostField& field, const Cell& cell) const {
    return reached_[field.index(cell.x, cell.y)] != 0;
  }

 private:
  std::vector<std::uint8_t> reached_;
  std::vector<std::uint32_t> waiting_;
  std::size_t count_ = 0;
  std::uint32_t low_ = 0, high_ = 0;  ///< cells reached lie in [low, high)
};

}  // namespace pilothouse
