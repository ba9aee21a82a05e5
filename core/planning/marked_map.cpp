#include "core/planning/marked_map.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pilothouse {
namespace {

constexpr double kBeyond = 1.0;  // so much more than a place that is to be covered [m]

}  // namespace

using Eigen::Vector2d;

/// With floor that nobody has seen round it, as far as is asked for; refused maps as they are.
MapCells MarkedMap::grown(const MapCells& map) const {
  const auto cells = static_cast<std::size_t>(std::max(0, map.size_x)) *
                     static_cast<std::size_t>(std::max(0, map.size_y));
  if (!(map.cell_size > 0.0) || map.size_x < 1 || map.size_y < 1 || map.cells.size() != cells)
    return map;
  CellWindow whole{-rim_, -rim_, map.size_x + rim_, map.size_y + rim_};
  if (covered_) {
    const int beyond = static_cast<int>(kBeyond / map.cell_size);
    const int x = map.column(covered_->x()), y = map.row(covered_->y());
    if (!map.contains(x, y)) {
      whole.include(x - beyond, y - beyond);
      whole.include(x + beyond, y + beyond);
    }
  }
  MapCells all;
  all.cell_size = map.cell_size;
  all.origin_x = map.origin_x + whole.x0 * map.cell_size;
  all.origin_y = map.origin_y + whole.y0 * map.cell_size;
  all.size_x = whole.x1 - whole.x0;
  all.size_y = whole.y1 - whole.y0;
  if (all.size_x > CostField::kMostSide || all.size_y > CostField::kMostSide) return map;
  all.cells.assign(static_cast<std::size_t>(all.size_x) * static_cast<std::size_t>(all.size_y),
                   MapCell::kUnknown);
  for (int y = 0; y < map.size_y; ++y) {
    const auto row = map.cells.begin() + static_cast<std::ptrdiff_t>(map.index(0, y));
    std::copy(row, row + map.size_x,
              all.cells.begin() + static_cast<std::ptrdiff_t>(all.index(-whole.x0, y - whole.y0)));
  }
  return all;
}

void MarkedMap::cover(const Vector2d& place, CostField& field) {
  covered_ = place;
  take(MapCells(clean_), field);
}

void MarkedMap::take(const MapCells& map, CostField& field) {
  if (rim_ > 0 || covered_) {
    MapCells all = grown(map);
    field.take(all);
    clean_ = std::move(all);
  } else {
    field.take(map);
    clean_ = map;
  }
  map_ = clean_;
  marked_.clear();
  ++revision_;
  mark(std::vector<MapMark>(marks_), field);
}

/// Whether the map itself has something as grave there or beside: then it was seen a little off.
bool MarkedMap::known(int x, int y, MapCell kind) const {
  for (int v = y - 1; v <= y + 1; ++v) {
    for (int u = x - 1; u <= x + 1; ++u) {
      if (clean_.at(u, v) >= kind) return true;
    }
  }
  return false;
}

void MarkedMap::layOut(const MapMark& mark) {
  if (!mark.place.allFinite() || !(mark.radius < 10.0)) return;
  if (!(std::abs(mark.place.x()) < 1e5 && std::abs(mark.place.y()) < 1e5)) return;
  const double radius = std::max(0.0, mark.radius);
  const auto kind = static_cast<std::size_t>(mark.kind);
  for (int y = map_.row(mark.place.y() - radius); y <= map_.row(mark.place.y() + radius); ++y) {
    for (int x = map_.column(mark.place.x() - radius); x <= map_.column(mark.place.x() + radius);
         ++x) {
      if (!map_.contains(x, y) || known(x, y, mark.kind)) continue;
      const Vector2d off = (Vector2d(map_.centreX(x), map_.centreY(y)) - mark.place).cwiseAbs();
      // The cell itself, and those whose middle the disc covers.
      const bool own = off.maxCoeff() <= 0.5 * map_.cell_size;
      if (own || off.norm() <= radius) marking_.push_back(map_.index(x, y) * 8 + kind);
    }
  }
}

bool MarkedMap::mark(const std::vector<MapMark>& marks, CostField& field) {
  marks_ = marks;
  marking_.clear();
  for (const MapMark& mark : marks_) layOut(mark);
  std::sort(marking_.begin(), marking_.end());
  marking_.erase(std::unique(marking_.begin(), marking_.end()), marking_.end());
  if (marking_ == marked_) return false;
  put(field);
  ++revision_;
  return true;
}

void MarkedMap::put(CostField& field) {
  CellWindow changed;
  const auto width = static_cast<std::size_t>(map_.size_x);
  const auto put = [&](std::size_t entry, bool on) {
    const std::size_t cell = entry / 8;
    map_.cells[cell] = on ? static_cast<MapCell>(entry % 8) : clean_.cells[cell];
    changed.include(static_cast<int>(cell % width), static_cast<int>(cell / width));
  };
  for (const std::size_t entry : marked_) {
    if (!std::binary_search(marking_.begin(), marking_.end(), entry)) put(entry, false);
  }
  // Rising: of two marks of one cell the graver comes last.
  for (const std::size_t entry : marking_) put(entry, true);
  marked_.swap(marking_);
  field.update(map_, changed);
}

}  // namespace pilothouse
