#include "core/mapping/occupancy_map.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace pilothouse {
namespace {

using Eigen::Vector2d;

}  // namespace

OccupancyMap::OccupancyMap(const OccupancyParameters& parameters)
    : parameters_(parameters), rule_(parameters) {
  std::string all;
  for (const auto& fault : validate(parameters)) all += (all.empty() ? "" : "; ") + fault;
  if (!all.empty()) throw std::invalid_argument(all);
  const auto blocks = [&](double metres) {
    return static_cast<int>(std::ceil(metres / parameters.cell_size / kBlock - 1e-9));
  };
  half_ = blocks(0.5 * parameters.max_side);
  blocks_.resize(static_cast<std::size_t>(4) * static_cast<std::size_t>(half_) *
                 static_cast<std::size_t>(half_));
  // One more on each side: the robot stands anywhere in its block.
  side_ = (2 * blocks(parameters.reach) + 3) * kBlock;
  evidence_.assign(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_), 0);
}
OccupancyMap::OccupancyMap(OccupancyMap&&) noexcept = default;
OccupancyMap& OccupancyMap::operator=(OccupancyMap&&) noexcept = default;
OccupancyMap::~OccupancyMap() = default;

OccupancyMap OccupancyMap::copy() const {
  OccupancyMap other(parameters_);
  other.anchor_ = anchor_;
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    if (blocks_[i]) other.blocks_[i] = std::make_unique<Block>(*blocks_[i]);
  }
  other.block_count_ = block_count_;
  other.version_ = version_;
  other.refused_cells_ = refused_cells_;
  return other;
}

CellPlace OccupancyMap::cellOf(double x, double y) const {
  const double size = parameters_.cell_size;
  return {static_cast<std::int32_t>(std::floor((x - anchor_.x()) / size)),
          static_cast<std::int32_t>(std::floor((y - anchor_.y()) / size))};
}

Vector2d OccupancyMap::centreOf(CellPlace place) const {
  const double size = parameters_.cell_size;
  return {anchor_.x() + (place.ix + 0.5) * size, anchor_.y() + (place.iy + 0.5) * size};
}

const OccupancyMap::Block* OccupancyMap::block(int column, int row) const {
  return inside(column, row) ? blocks_[slot(column, row)].get() : nullptr;
}

OccupancyMap::Block* OccupancyMap::ensureBlock(int column, int row) {
  if (!inside(column, row)) return nullptr;
  auto& block = blocks_[slot(column, row)];
  if (!block) {
    block = std::make_unique<Block>();
    ++block_count_;
  }
  return block.get();
}

MapCellState OccupancyMap::state(CellPlace place) const {
  const int column = blockOf(place.ix), row = blockOf(place.iy);
  const Block* known = block(column, row);
  if (known == nullptr) return {};
  return (*known)[static_cast<std::size_t>((place.iy - row * kBlock) * kBlock + place.ix -
                                           column * kBlock)];
}

void OccupancyMap::clear() {
  for (auto& block : blocks_) block.reset();
  block_count_ = 0;
  refused_cells_ = 0;
  ++version_;
}

void OccupancyMap::set(const std::vector<CellPlace>& places, MapCell judged) {
  bool changed = false;
  for (const CellPlace place : places) {
    const int column = blockOf(place.ix), row = blockOf(place.iy);
    Block* block = ensureBlock(column, row);
    if (block == nullptr) {
      ++refused_cells_;
      continue;
    }
    MapCellState& cell = (*block)[static_cast<std::size_t>((place.iy - row * kBlock) * kBlock +
                                                           place.ix - column * kBlock)];
    changed = changed || rule_.judge(cell) != judged;
    cell = rule_.stateOf(judged);
  }
  if (changed) ++version_;
}

void OccupancyMap::forEachBlock(const std::function<void(int, int, const Block&)>& visit) const {
  for (int row = -half_; row < half_; ++row) {
    for (int column = -half_; column < half_; ++column) {
      if (const Block* known = block(column, row)) visit(column, row, *known);
    }
  }
}

void OccupancyMap::snapshot(MapCells& out) const {
  int low_x = half_, low_y = half_, high_x = -half_ - 1, high_y = -half_ - 1;
  forEachBlock([&](int column, int row, const Block&) {
    low_x = std::min(low_x, column), high_x = std::max(high_x, column);
    low_y = std::min(low_y, row), high_y = std::max(high_y, row);
  });
  const bool empty = block_count_ == 0;
  const double side = kBlock * parameters_.cell_size;
  out.cell_size = parameters_.cell_size;
  out.origin_x = anchor_.x() + (empty ? 0.0 : low_x * side);
  out.origin_y = anchor_.y() + (empty ? 0.0 : low_y * side);
  out.size_x = empty ? 0 : (high_x - low_x + 1) * kBlock;
  out.size_y = empty ? 0 : (high_y - low_y + 1) * kBlock;
  out.cells.assign(static_cast<std::size_t>(out.size_x) * static_cast<std::size_t>(out.size_y),
                   MapCell::kUnknown);
  forEachBlock([&](int column, int row, const Block& block) {
    for (int y = 0; y < kBlock; ++y) {
      MapCell* to = &out.cells[out.index((column - low_x) * kBlock, (row - low_y) * kBlock + y)];
      const MapCellState* from = &block[static_cast<std::size_t>(y * kBlock)];
      for (int x = 0; x < kBlock; ++x) to[x] = rule_.judge(from[x]);
    }
  });
}

}  // namespace pilothouse
