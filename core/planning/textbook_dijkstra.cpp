#include "core/planning/textbook_dijkstra.hpp"

#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace pilothouse {

std::optional<std::uint32_t> TextbookDijkstra::find(const CostField& field, const Cell& start,
                                                    const Cell& goal) {
  using Entry = std::pair<std::uint32_t, std::uint32_t>;  // cost, cell
  const auto& weights = field.weights();
  costs_.assign(weights.size(), std::numeric_limits<std::uint32_t>::max());
  parents_.resize(weights.size());
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
  const std::uint32_t end = field.index(goal.x, goal.y);
  const int stride = field.stride();
  costs_[field.index(start.x, start.y)] = 0;
  queue.push({0, field.index(start.x, start.y)});
  while (!queue.empty()) {
    // No structured binding: clang lets no lambda see one.
    const std::uint32_t cost = queue.top().first, cell = queue.top().second;
    queue.pop();
    if (cost > costs_[cell]) continue;
    if (cell == end) return cost;
    const auto weightAt = [&](int dx, int dy) -> std::uint32_t {
      return weights[static_cast<std::size_t>(static_cast<int>(cell) + dy * stride + dx)];
    };
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        if ((dx == 0 && dy == 0) || weightAt(dx, dy) == 0) continue;
        const bool slant = dx != 0 && dy != 0;
        if (slant && (weightAt(dx, 0) == 0 || weightAt(0, dy) == 0)) continue;
        const auto next = static_cast<std::uint32_t>(static_cast<int>(cell) + dy * stride + dx);
        const std::uint32_t step = (slant ? GridSearch::kSlant : GridSearch::kStraight) *
                                   (weights[cell] + weightAt(dx, dy));
        if (cost + step >= costs_[next]) continue;
        costs_[next] = cost + step;
        parents_[next] = cell;
        queue.push({cost + step, next});
      }
    }
  }
  return std::nullopt;
}

}  // namespace pilothouse
