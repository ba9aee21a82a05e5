#include "core/planning/cost_field.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <stdexcept>

namespace pilothouse {
namespace {

constexpr double kFarAway = 1e3;  // beyond the reach [m]

/// Unlike any before, so that nobody takes one field for another.
std::uint64_t newRevision() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

std::size_t at(MapCell cell) {
  return static_cast<std::size_t>(cell);
}

}  // namespace

CostField::CostField(const PlanningParameters& parameters, double inscribed, double reach)
    : parameters_(parameters),
      least_(inscribed + parameters.clearance),
      comfortable_(inscribed + std::max(parameters.clearance, parameters.wish)),
      needed_(std::max(reach, least_)),
      reach_(std::max(reach, comfortable_)) {
  blocks_[at(MapCell::kOccupied)] = blocks_[at(MapCell::kDropOff)] = 1;
  blocks_[at(MapCell::kUnknown)] = parameters.unknown == UnknownFloor::kNever ? 1 : 0;
}

/// Falls from 1 at the least clearance to 0 where it is comfortable, ever more gently.
double CostField::closenessAt(double clearance) const {
  if (clearance >= comfortable_) return 0.0;
  const double share = (comfortable_ - clearance) / (comfortable_ - least_);
  return share * share;
}

void CostField::layOut(double cell_size) {
  cell_size_ = cell_size;
  const int reach = static_cast<int>(std::ceil(reach_ / cell_size + 0.5));
  clearances_.resize(size_x_, size_y_, reach);
  const auto squares = static_cast<std::size_t>(clearances_.most()) + 1;
  distances_.resize(squares);
  for (auto& table : tables_) table.assign(squares, 0);
  for (std::size_t square = 0; square < squares; ++square) {
    // To the edge of the blocked cell, not to its middle.
    const double clearance = std::max(0.0, std::sqrt(static_cast<double>(square)) - 0.5);
    const bool beyond = square + 1 == squares;
    distances_[square] = beyond ? kFarAway : clearance * cell_size;
    if (distances_[square] < least_) continue;
    const double near = 1.0 + parameters_.closeness * closenessAt(distances_[square]);
    const auto weight = [near](double more) {
      return static_cast<std::uint8_t>(std::lround(std::min(255.0, kPlain * (near + more))));
    };
    tables_[at(MapCell::kFree)][square] = weight(0.0);
    tables_[at(MapCell::kThreshold)][square] = weight(parameters_.threshold_cost);
    tables_[at(MapCell::kUnknown)][square] = weight(parameters_.unknown_cost);
  }
}

void CostField::take(const MapCells& map) {
  if (map.size_x < 1 || map.size_y < 1 || map.size_x > kMostSide || map.size_y > kMostSide ||
      !(map.cell_size > 0.0) ||
      map.cells.size() !=
          static_cast<std::size_t>(map.size_x) * static_cast<std::size_t>(map.size_y)) {
    throw std::invalid_argument("map of " + std::to_string(map.size_x) + " x " +
                                std::to_string(map.size_y) + " cells with " +
                                std::to_string(map.cells.size()) + " values, expected 1 to " +
                                std::to_string(kMostSide) + " a side and as many values");
  }
  // Farther than that nothing would count as near, though it touched.
  const double finest = needed_ / (ClearanceField::kMostReach - 1.5);
  if (map.cell_size < finest) {
    throw std::invalid_argument("map with cells of " + std::to_string(map.cell_size) +
                                " m, expected at least " + std::to_string(finest) +
                                " m for this robot's size and clearance");
  }
  const bool same = size_x_ == map.size_x && size_y_ == map.size_y && cell_size_ == map.cell_size;
  size_x_ = map.size_x;
  size_y_ = map.size_y;
  if (!same) {
    layOut(map.cell_size);
    blocked_.resize(map.cells.size());
    revisions_.assign(static_cast<std::size_t>(size_y_), 0);
    weights_.assign(static_cast<std::size_t>(stride()) * static_cast<std::size_t>(size_y_ + 2), 0);
  }
  update(map, {0, 0, size_x_, size_y_});
}

void CostField::update(const MapCells& map, const CellWindow& changed) {
  const CellWindow window = changed.grown(0, size_x_, size_y_);
  for (int y = window.y0; y < window.y1; ++y) {
    for (std::size_t i = map.index(window.x0, y); i < map.index(window.x1, y); ++i) {
      blocked_[i] = blocks_[at(map.cells[i])];
    }
  }
  weigh(map, clearances_.update(blocked_.data(), window));
}

void CostField::set(int x, int y, int weight) {
  weights_[index(x, y)] = static_cast<std::uint8_t>(weight);
  revisions_[static_cast<std::size_t>(y)] = newRevision();
}

void CostField::weigh(const MapCells& map, const CellWindow& window) {
  const std::uint64_t revision = newRevision();
  std::array<const std::uint8_t*, 5> tables{};
  for (std::size_t kind = 0; kind < tables.size(); ++kind) tables[kind] = tables_[kind].data();
  for (int y = window.y0; y < window.y1; ++y) {
    const std::int16_t* const squares = clearances_.row(y);
    const MapCell* const cells = map.cells.data() + map.index(0, y);
    revisions_[static_cast<std::size_t>(y)] = revision;
    std::uint8_t* const weights = weights_.data() + index(0, y);
    for (int x = window.x0; x < window.x1; ++x) {
      weights[x] = tables[at(cells[x])][static_cast<std::size_t>(squares[x])];
    }
  }
}

}  // namespace pilothouse
