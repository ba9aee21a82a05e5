#include "core/planning/grid_search.hpp"

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

namespace pilothouse {
namespace {

// The estimate must not jump beyond the ring of buckets in one step: a slant step at the greatest
// weight, there and back.
constexpr std::uint32_t kLongestJump = 2 * GridSearch::kSlant * 2 * 255;
static_assert((BucketQueue::kBuckets << BucketQueue::kBits) > kLongestJump, "see above");
// No step is shorter than a bucket is wide, so what a cost rests on lies in an earlier bucket.
static_assert(GridSearch::kUnit >= 1U << BucketQueue::kBits, "see above");

constexpr std::size_t kFewCells = 4096;  // are always mended
constexpr std::size_t kMostShare = 8;    // beginning anew is quicker than mending an eighth of all

}  // namespace

/// Calls visit(neighbour, cost of the step, dx, dy) for every step that is open, until that is
/// true.
template <class Visit>
void GridSearch::eachStep(std::uint32_t cell, Visit visit) const {
  const std::uint8_t* const weights = weights_.data();
  const std::uint32_t up = cell + stride_, down = cell - stride_;
  const std::uint32_t own = weights[cell];
  const std::uint32_t east = weights[cell + 1], west = weights[cell - 1];
  const std::uint32_t north = weights[up], south = weights[down];
  const std::uint32_t ne = weights[up + 1], nw = weights[up - 1];
  const std::uint32_t se = weights[down + 1], sw = weights[down - 1];
  const auto straight = [own](std::uint32_t weight) { return kStraight * (own + weight); };
  const auto slant = [own](std::uint32_t weight) { return kSlant * (own + weight); };
  if (east != 0 && visit(cell + 1, straight(east), 1, 0)) return;
  if (west != 0 && visit(cell - 1, straight(west), -1, 0)) return;
  if (north != 0) {
    if (visit(up, straight(north), 0, 1)) return;
    if (east != 0 && ne != 0 && visit(up + 1, slant(ne), 1, 1)) return;
    if (west != 0 && nw != 0 && visit(up - 1, slant(nw), -1, 1)) return;
  }
  if (south != 0) {
    if (visit(down, straight(south), 0, -1)) return;
    if (east != 0 && se != 0 && visit(down + 1, slant(se), 1, -1)) return;
    if (west != 0 && sw != 0) visit(down - 1, slant(sw), -1, -1);
  }
}

/// Never more than what the way from the start costs.
std::uint32_t GridSearch::remaining(int x, int y) const {
  const auto dx = static_cast<std::uint32_t>(std::abs(x - start_.x));
  const auto dy = static_cast<std::uint32_t>(std::abs(y - start_.y));
  const std::uint32_t most = dx > dy ? dx : dy, least = dx > dy ? dy : dx;
  return 2 * CostField::kPlain * (kStraight * (most - least) + kSlant * least);
}

void GridSearch::expand(const Entry& entry) {
  const std::uint32_t here = index(entry.x, entry.y);
  if (costs_[here] != entry.cost || entry.cost > kDearest) return;  // or entered more cheaply since
  ++expanded_;
  taken_.include(entry.x, entry.y);
  eachStep(here, [&](std::uint32_t to, std::uint32_t step, int dx, int dy) {
    const std::uint32_t cost = entry.cost + step;
    std::uint32_t& known = costs_[to];
    if (cost >= known) return false;
    if (known == kFar) ++entered_;
    known = cost;
    const int x = entry.x + dx, y = entry.y + dy;
    open_.push({static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y), cost},
               cost + remaining(x, y));
    return false;
  });
}

/// Whether what is known is of this goal in such a field.
bool GridSearch::knows(const CostField& field, const Cell& goal) const {
  return goal == goal_ && size_x_ == field.sizeX() && size_y_ == field.sizeY();
}

/// Forgets all costs, and takes the field as it is.
void GridSearch::begin(const CostField& field, const Cell& goal) {
  if (size_x_ != field.sizeX() || size_y_ != field.sizeY()) {
    size_x_ = field.sizeX();
    size_y_ = field.sizeY();
    stride_ = static_cast<std::uint32_t>(field.stride());
    costs_.assign(field.weights().size(), kFar);
    weights_.assign(field.weights().size(), 0);
    seen_.assign(field.weights().size(), false);
    revisions_.assign(static_cast<std::size_t>(size_y_), 0);
  } else if (!taken_.empty()) {
    const CellWindow window = taken_.grown(1, size_x_, size_y_);
    for (int y = window.y0; y < window.y1; ++y) {
      std::fill(costs_.begin() + index(window.x0, y), costs_.begin() + index(window.x1, y), kFar);
    }
  }
  for (int y = 0; y < size_y_; ++y) {
    std::uint64_t& revision = revisions_[static_cast<std::size_t>(y)];
    if (revision == field.revision(y)) continue;
    revision = field.revision(y);
    const auto row = field.weights().begin() + index(0, y);
    std::copy(row, row + size_x_, weights_.begin() + index(0, y));
  }
  open_.drain(all_);
  doubted_.drain(dropped_);
  goal_ = goal;
  taken_ = {};
  taken_.include(goal.x, goal.y);
  entered_ = 1;
  costs_[index(goal.x, goal.y)] = 0;
  open_.push({static_cast<std::uint16_t>(goal.x), static_cast<std::uint16_t>(goal.y), 0}, 0);
}

/// Takes over the field's weights. @return whether few enough have changed to be mended.
bool GridSearch::noteChanges(const CostField& field) {
  changed_.clear();
  const std::size_t most = kFewCells + entered_ / kMostShare;
  for (int y = 0; y < size_y_ && changed_.size() < most; ++y) {
    std::uint64_t& revision = revisions_[static_cast<std::size_t>(y)];
    if (revision == field.revision(y)) continue;
    revision = field.revision(y);
    const std::uint8_t* const now = field.weights().data() + index(0, y);
    std::uint8_t* const known = weights_.data() + index(0, y);
    for (int x = 0; x < size_x_; ++x) {
      if (now[x] == known[x]) continue;
      known[x] = now[x];
      changed_.push_back({x, y});
    }
  }
  return changed_.size() < most;
}

/// Whether the cell can have its cost by a step to a neighbour with a cost.
bool GridSearch::supported(std::uint32_t cell) const {
  if (weights_[cell] == 0) return false;
  bool found = false;
  eachStep(cell, [&](std::uint32_t to, std::uint32_t step, int, int) {
    found = costs_[to] < costs_[cell] && costs_[to] + step <= costs_[cell];
    return found;
  });
  return found;
}

void GridSearch::reopen(std::uint32_t cell, int x, int y) {
  if (costs_[cell] == kFar) return;
  open_.push({static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y), costs_[cell]},
             costs_[cell] + remaining(x, y));
}

/// Forgets every cost that rested on what has changed, the least first: whatever it may rest on
/// else was judged before it. Then what lies round those cells, and round the changed ones, is open
/// again. @return false: that is too much of all.
bool GridSearch::mend() {
  const auto round = [this](const Cell& cell, auto visit) {
    for (int y = cell.y - 1; y <= cell.y + 1; ++y) {
      for (int x = cell.x - 1; x <= cell.x + 1; ++x) {
        const std::uint32_t at = index(x, y);
        if (costs_[at] != kFar) visit(at, x, y);
      }
    }
  };
  const auto doubt = [this](std::uint32_t at, int x, int y) {
    const Entry entry{static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y), costs_[at]};
    if (entry.cost > 0) doubted_.push(entry, entry.cost);
  };
  for (const Cell& cell : changed_) round(cell, doubt);
  const std::size_t most = kFewCells + entered_ / kMostShare;
  dropped_.clear();
  Entry entry{};
  while (doubted_.next()) {
    while (doubted_.take(entry)) {
      const std::uint32_t here = index(entry.x, entry.y);
      if (costs_[here] != entry.cost || supported(here)) continue;
      if (dropped_.size() == most) return false;
      costs_[here] = kFar;
      dropped_.push_back(entry);
      round({entry.x, entry.y}, [&](std::uint32_t at, int x, int y) {
        if (costs_[at] > entry.cost) doubt(at, x, y);
      });
    }
  }
  doubted_.drain(all_);
  const auto open = [this](std::uint32_t at, int x, int y) { reopen(at, x, y); };
  for (const Cell& cell : changed_) round(cell, open);
  for (const Entry& gone : dropped_) round({gone.x, gone.y}, open);
  return true;
}

/// What is open, once a cell, in the order that the start asks for.
void GridSearch::order() {
  open_.drain(all_);
  std::size_t kept = 0;
  for (const Entry entry : all_) {
    const std::uint32_t at = index(entry.x, entry.y);
    if (costs_[at] != entry.cost || seen_[at]) continue;
    seen_[at] = true;
    all_[kept++] = entry;
  }
  all_.resize(kept);
  for (const Entry& entry : all_) {
    seen_[index(entry.x, entry.y)] = false;
    open_.push(entry, entry.cost + remaining(entry.x, entry.y));
  }
}

/// Until whatever is still open costs more than the way that is known.
void GridSearch::run() {
  const std::uint32_t& end = costs_[index(start_.x, start_.y)];
  Entry entry{};
  while (open_.next()) {
    if (end != kFar && end >> BucketQueue::kBits < open_.bucket()) return;
    while (open_.take(entry)) expand(entry);
  }
}

std::optional<std::uint32_t> GridSearch::find(const CostField& field, const Cell& start,
                                              const Cell& goal) {
  expanded_ = 0;
  start_ = start;
  if (!knows(field, goal) || !noteChanges(field) || !mend()) begin(field, goal);
  order();
  run();
  const std::uint32_t cost = costs_[index(start.x, start.y)];
  if (cost == kFar) return std::nullopt;
  return cost;
}

void GridSearch::trace(std::vector<Cell>& way) const {
  way.clear();
  Cell at = start_;
  way.push_back(at);
  while (!(at == goal_)) {
    const std::uint32_t here = index(at.x, at.y);
    Cell next = at;
    // Each cost is that of some neighbour and the step there, to the digit.
    eachStep(here, [&](std::uint32_t to, std::uint32_t step, int dx, int dy) {
      if (costs_[to] > costs_[here] || costs_[to] + step != costs_[here]) return false;
      next = {at.x + dx, at.y + dy};
      return true;
    });
    if (next == at) throw std::logic_error("no way was found that could be traced");
    at = next;
    way.push_back(at);
  }
}

}  // namespace pilothouse
