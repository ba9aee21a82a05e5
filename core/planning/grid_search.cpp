#include "core/planning/grid_search.hpp"

#include <algorithm>
#include <cstdlib>

namespace pilothouse {
namespace {

// What is wanted of a ring of buckets: more than the farthest jump of the estimate in one step,
// which is a slant step at the greatest weight there and back.
constexpr std::uint32_t kDearest = 2 * 99 * 2 * 255;
constexpr std::uint32_t kBuckets = 64;
static_assert((kBuckets << 11) > kDearest, "the ring must hold every step");

}  // namespace

void GridSearch::prepare(const CostField& field) {
  const std::size_t cells = field.weights().size();
  if (costs_.size() != cells) {
    costs_.assign(cells, kFar);
    buckets_.resize(kBuckets);
  } else if (touched_.size() > cells / 8) {
    std::fill(costs_.begin(), costs_.end(), kFar);
  } else {
    for (const std::uint32_t cell : touched_) costs_[cell] = kFar;
  }
  touched_.clear();
  for (auto& bucket : buckets_) bucket.clear();
  waiting_ = expanded_ = 0;
  stride_ = static_cast<std::uint32_t>(field.stride());
}

/// Never more than what the way to the goal costs.
std::uint32_t GridSearch::remaining(int x, int y) const {
  const auto dx = static_cast<std::uint32_t>(std::abs(x - goal_.x));
  const auto dy = static_cast<std::uint32_t>(std::abs(y - goal_.y));
  const std::uint32_t most = dx > dy ? dx : dy, least = dx > dy ? dy : dx;
  return 2 * CostField::kPlain * (kStraight * (most - least) + kSlant * least);
}

void GridSearch::push(int x, int y, std::uint32_t cost) {
  const std::uint32_t estimate = cost + remaining(x, y);
  buckets_[(estimate >> kBucketBits) % kBuckets].push_back(
      {static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y), cost});
  ++waiting_;
}

template <class Weights>
void GridSearch::expand(const Weights& weights, const Entry& entry) {
  const std::uint32_t here = (entry.y + 1U) * stride_ + entry.x + 1U;
  if (costs_[here] != entry.cost) return;  // it was entered more cheaply since
  ++expanded_;
  const std::uint32_t up = here + stride_, down = here - stride_;
  const std::uint32_t own = weights[here];
  const auto enter = [&](std::uint32_t to, std::uint32_t weight, std::uint32_t length, int dx,
                         int dy) {
    const std::uint32_t cost = entry.cost + length * (own + weight);
    std::uint32_t& known = costs_[to];
    if (cost >= known) return;
    if (known == kFar) touched_.push_back(to);
    known = cost;
    push(entry.x + dx, entry.y + dy, cost);
  };
  const std::uint32_t east = weights[here + 1], west = weights[here - 1];
  const std::uint32_t north = weights[up], south = weights[down];
  if (east != 0) enter(here + 1, east, kStraight, 1, 0);
  if (west != 0) enter(here - 1, west, kStraight, -1, 0);
  if (north != 0) {
    enter(up, north, kStraight, 0, 1);
    if (east != 0 && weights[up + 1] != 0) enter(up + 1, weights[up + 1], kSlant, 1, 1);
    if (west != 0 && weights[up - 1] != 0) enter(up - 1, weights[up - 1], kSlant, -1, 1);
  }
  if (south != 0) {
    enter(down, south, kStraight, 0, -1);
    if (east != 0 && weights[down + 1] != 0) enter(down + 1, weights[down + 1], kSlant, 1, -1);
    if (west != 0 && weights[down - 1] != 0) enter(down - 1, weights[down - 1], kSlant, -1, -1);
  }
}

std::optional<std::uint32_t> GridSearch::find(const CostField& field, const Cell& start,
                                              const Cell& goal) {
  prepare(field);
  start_ = start;
  goal_ = goal;
  const std::uint8_t* const weights = field.weights().data();
  const std::uint32_t end = field.index(goal.x, goal.y);
  costs_[field.index(start.x, start.y)] = 0;
  touched_.push_back(field.index(start.x, start.y));
  push(start.x, start.y, 0);
  for (std::uint32_t bucket = remaining(start.x, start.y) >> kBucketBits; waiting_ > 0; ++bucket) {
    // Whatever is still to come costs more than the way that is known.
    if (costs_[end] != kFar && costs_[end] >> kBucketBits < bucket) break;
    auto& entries = buckets_[bucket % kBuckets];
    while (!entries.empty()) {
      const Entry entry = entries.back();
      entries.pop_back();
      --waiting_;
      expand(weights, entry);
    }
  }
  if (costs_[end] == kFar) return std::nullopt;
  return costs_[end];
}

void GridSearch::trace(const CostField& field, std::vector<Cell>& way) const {
  way.clear();
  const auto& weights = field.weights();
  Cell at = goal_;
  way.push_back(at);
  while (!(at == start_)) {
    const std::uint32_t here = field.index(at.x, at.y);
    Cell before = at;
    // Each cost is that of some neighbour and the step from there, to the digit.
    for (int dy = -1; dy <= 1 && before == at; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        if (dx == 0 && dy == 0) continue;
        const std::uint32_t from = field.index(at.x + dx, at.y + dy);
        if (weights[from] == 0 || costs_[from] == kFar) continue;
        const bool slant = dx != 0 && dy != 0;
        if (slant && (weights[field.index(at.x + dx, at.y)] == 0 ||
                      weights[field.index(at.x, at.y + dy)] == 0)) {
          continue;
        }
        const std::uint32_t sum = std::uint32_t{weights[here]} + weights[from];
        if (costs_[from] + (slant ? kSlant : kStraight) * sum != costs_[here]) continue;
        before = {at.x + dx, at.y + dy};
        break;
      }
    }
    at = before;
    way.push_back(at);
  }
  std::reverse(way.begin(), way.end());
}

}  // namespace pilothouse
