#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/mapping/map_cells.hpp"
#include "core/planning/clearance_field.hpp"
#include "core/planning/planning_parameters.hpp"

namespace pilothouse {

/// What a step through each cell of a map costs a robot whose middle goes there, and how far from
/// things that is. Cells have weights: kPlain where the way is clear, more near things, on
/// thresholds and on unknown floor, 0 where the robot must not be. Weights have a border of zeros
/// round them, so that a search need not ask where the map ends.
class CostField {
 public:
  static constexpr int kPlain = 16;
  static constexpr int kMostSide = 20000;  ///< cells

  /// @param inscribed radius of the circle about the base's origin that lies within the footprint,
  /// @param reach farthest that anybody will ask for a clearance [m].
  CostField(const PlanningParameters& parameters, double inscribed, double reach);

  /// A new map; nothing blocked besides. @param map at most kMostSide cells a side.
  void take(const MapCells& map);
  /// The map's cells within the window, again, after they changed. Allocates nothing.
  void update(const MapCells& map, const CellWindow& changed);

  int sizeX() const { return size_x_; }
  int sizeY() const { return size_y_; }
  int stride() const { return size_x_ + 2; }
  /// Index of a cell's weight.
  std::uint32_t index(int x, int y) const {
    return static_cast<std::uint32_t>((y + 1) * stride() + x + 1);
  }
  const std::vector<std::uint8_t>& weights() const { return weights_; }
  std::uint8_t weight(int x, int y) const { return weights_[index(x, y)]; }
  /// For a search that must keep off a cell though nothing is there, or may go there though it is
  /// near to something; until the next update there.
  void set(int x, int y, int weight);
  /// Another number, of all that any field had, whenever weights of the row may have changed.
  std::uint64_t revision(int y) const { return revisions_[static_cast<std::size_t>(y)]; }

  /// Distance from the cell's middle to the edge of the nearest blocked cell, straight; too little
  /// by a fifth of a cell at most where that lies askew [m]. Large where it is beyond the reach.
  double clearance(int x, int y) const {
    return distances_[static_cast<std::size_t>(clearances_.square(x, y))];
  }
  bool blocked(int x, int y) const {
    return blocked_[static_cast<std::size_t>(y) * static_cast<std::size_t>(size_x_) +
                    static_cast<std::size_t>(x)] != 0;
  }
  /// Least clearance that a cell with a weight has [m].
  double least() const { return least_; }
  /// Clearances are told up to this [m].
  double reach() const { return reach_; }

 private:
  void layOut(double cell_size);
  void weigh(const MapCells& map, const CellWindow& window);
  double closenessAt(double clearance) const;

  PlanningParameters parameters_;
  double least_, comfortable_, needed_, reach_;
  double cell_size_ = 0.0;
  int size_x_ = 0, size_y_ = 0;
  std::array<std::uint8_t, 5> blocks_{};  ///< by MapCell
  ClearanceField clearances_;
  std::vector<double> distances_;                    ///< by square
  std::array<std::vector<std::uint8_t>, 5> tables_;  ///< weight by MapCell and square
  std::vector<std::uint8_t> blocked_;
  std::vector<std::uint8_t> weights_;
  std::vector<std::uint64_t> revisions_;  ///< of rows
};

}  // namespace pilothouse
