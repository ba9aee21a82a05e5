#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/planning/grid_search.hpp"

namespace pilothouse {

/// Dijkstra's algorithm as books have it: a binary heap, eight neighbours, ends at the goal. The
/// plain version that the planner's search is held against, with the same costs. Keeps its memory
/// from one search to the next.
class TextbookDijkstra {
 public:
  /// @return the cost as GridSearch::find has it; nothing: there is no way.
  std::optional<std::uint32_t> find(const CostField& field, const Cell& start, const Cell& goal);

 private:
  std::vector<std::uint32_t> costs_, parents_;
};

}  // namespace pilothouse
