#pragma once

#include <cstdint>
#include <vector>

#include "core/planning/grid_search.hpp"

namespace pilothouse {

/// The cells of a cost field that can be reached from one of them.
class Reach {
 public:
  /// @param from within the field; reaches nothing where its weight is 0.
  void spread(const CostField& field, const Cell& from);
  bool holds(const CostField& field, const Cell& cell) const {
    return reached_[field.index(cell.x, cell.y)] != 0;
  }

 private:
  std::vector<std::uint8_t> reached_;
  std::vector<std::uint32_t> waiting_;
};

}  // namespace pilothouse
