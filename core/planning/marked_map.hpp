#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/mapping/map_cells.hpp"
#include "core/planning/cost_field.hpp"

namespace pilothouse {

/// Something seen now, whether the map has it or not: a disc, map frame.
struct MapMark {
  Eigen::Vector2d place;  ///< [m]
  double radius;          ///< [m], below 10
  MapCell kind = MapCell::kOccupied;
  bool remembered = false;  ///< not in the newest view
  bool hidden = false;      ///< not seen at all: may stand behind what is (see HiddenSides)
};

/// A map with what is seen now laid upon it.
class MarkedMap {
 public:
  /// Lays this many cells of floor that nobody has seen round every map from now on.
  void surround(int rim) { rim_ = rim; }
  /// And so many that a place lies among them: the way there leads out of the map.
  void cover(const Eigen::Vector2d& place, CostField& field);
  /// A new map; marks stay. `field` is of what comes of it; of a map that lies as the last one did
  /// it takes what changed.
  /// @throws std::invalid_argument naming what is wrong with its size.
  void take(const MapCells& map, CostField& field);
  /// Replaces all earlier marks. What lies within a cell of something as grave in the map is that.
  /// @return whether anything changed.
  bool mark(const std::vector<MapMark>& marks, CostField& field);

  const MapCells& cells() const { return map_; }  ///< marks included
  const std::vector<MapMark>& marks() const { return marks_; }
  /// Whether the map itself, without marks, has something as grave there or beside: what is seen
  /// there was seen a little off.
  bool knows(const Eigen::Vector2d& place, MapCell kind) const {
    return known(map_.column(place.x()), map_.row(place.y()), kind);
  }
  /// Another number whenever map or marks have changed.
  std::uint32_t revision() const { return revision_; }
  /// For a look at what the map would be without them that leaves no trace.
  void setRevision(std::uint32_t revision) { revision_ = revision; }

 private:
  MapCells grown(const MapCells& map) const;
  bool known(int x, int y, MapCell kind) const;
  bool renew(const MapCells& map, CostField& field);
  void layOut();
  void layOut(const MapMark& mark);
  void put(CostField& field);

  MapCells clean_, map_;  ///< without and with marks
  std::vector<MapMark> marks_;
  std::vector<std::size_t> marked_, marking_;  ///< cell * 8 + kind, rising
  std::vector<CellWindow> changed_;
  std::uint32_t revision_ = 0;
  int rim_ = 0;
  std::optional<Eigen::Vector2d> covered_;
};

}  // namespace pilothouse
