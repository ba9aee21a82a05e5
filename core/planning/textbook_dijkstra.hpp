#pragma once

#include <cstdint>
#include <optional>

#include "core/planning/grid_search.hpp"

namespace pilothouse {

/// Dijkstra's algorithm as books have it: a binary heap, eight neighbours, ends at the goal. The
/// plain version that the planner's search is held against, with the same costs.
/// @return the cost as GridSearch::find has it; nothing: there is no way.
std::optional<std::uint32_t> textbookDijkstra(const CostField& field, const Cell& start,
                                              const Cell& goal);

}  // namespace pilothouse
