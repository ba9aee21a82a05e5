#include "core/planning/marked_map.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace pilothouse {
namespace {

constexpr double kBeyond = 1.0;            // so much more than a place that is to be covered [m]
constexpr double kFarthestCovered = 50.0;  // off a map, which may be another than it was for [m]
constexpr int kPiece = 64;                 // what changed is found in squares of this side [cells]
constexpr std::size_t kMostShare = 4;      // where more than a quarter of them did, all are taken

bool sameLayout(const MapCells& a, const MapCells& b) {
  return a.size_x == b.size_x && a.size_y == b.size_y && a.cell_size == b.cell_size &&
         a.origin_x == b.origin_x && a.origin_y == b.origin_y && a.cells.size() == b.cells.size();
}

/// Calls visit(begin, count) for the rows of a window: where they lie among the cells.
template <class Visit>
void eachRow(const MapCells& map, const CellWindow& window, Visit visit) {
  for (int y = window.y0; y < window.y1; ++y) {
    visit(map.index(window.x0, y), static_cast<std::size_t>(window.x1 - window.x0));
  }
}

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
    const int most = static_cast<int>(kFarthestCovered / map.cell_size);
    const bool near = x > -most && y > -most && x < map.size_x + most && y < map.size_y + most;
    if (near && !map.contains(x, y)) {
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
  const bool grows = rim_ > 0 || covered_;
  MapCells all;
  if (grows) all = grown(map);
  const MapCells& whole = grows ? all : map;
  if (sameLayout(whole, clean_) && map_.size_x > 0) {
    if (renew(whole, field)) ++revision_;
    return;
  }
  field.take(whole);
  if (grows) {
    clean_ = std::move(all);
  } else {
    clean_ = map;
  }
  map_ = clean_;
  marked_.clear();
  ++revision_;
  mark(std::vector<MapMark>(marks_), field);
}

/// Takes over what another map of the same layout has otherwise. @return whether it has anything.
bool MarkedMap::renew(const MapCells& map, CostField& field) {
  changed_.clear();
  std::size_t pieces = 0;
  for (int y = 0; y < map.size_y; y += kPiece) {
    for (int x = 0; x < map.size_x; x += kPiece, ++pieces) {
      const CellWindow piece{x, y, std::min(map.size_x, x + kPiece),
                             std::min(map.size_y, y + kPiece)};
      bool same = true;
      eachRow(map, piece, [&](std::size_t begin, std::size_t count) {
        same = same && std::memcmp(&map.cells[begin], &clean_.cells[begin], count) == 0;
      });
      if (!same) changed_.push_back(piece);
    }
  }
  if (changed_.empty()) return false;
  marking_.clear();
  put(field);
  for (const CellWindow& piece : changed_) {
    eachRow(map, piece, [&](std::size_t begin, std::size_t count) {
      std::memcpy(&clean_.cells[begin], &map.cells[begin], count);
      std::memcpy(&map_.cells[begin], &map.cells[begin], count);
    });
  }
  if (changed_.size() * kMostShare > pieces) {
    field.take(map_);
  } else {
    for (const CellWindow& piece : changed_) field.update(map_, piece);
  }
  layOut();
  put(field);
  return true;
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

/// All marks, as cells.
void MarkedMap::layOut() {
  marking_.clear();
  for (const MapMark& mark : marks_) layOut(mark);
  std::sort(marking_.begin(), marking_.end());
  marking_.erase(std::unique(marking_.begin(), marking_.end()), marking_.end());
}

bool MarkedMap::mark(const std::vector<MapMark>& marks, CostField& field) {
  marks_ = marks;
  layOut();
  if (marking_ == marked_) return false;
  put(field);
  ++revision_;
  return true;
}

/// Lays out `marking_` for `marked_`.
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
