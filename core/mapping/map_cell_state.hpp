#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/mapping/map_cells.hpp"
#include "core/mapping/occupancy_parameters.hpp"

namespace pilothouse {

/// What one frame says of one cell. Where several things are said, the greatest counts.
enum class CellEvidence : std::uint8_t {
  kNone = 0,
  kFree = 1,
  kThreshold = 2,
  kDropOff = 3,
  kPassing = 4,   ///< an obstacle that may well go on
  kObstacle = 5,  ///< one that stays, or that a scan met
};

/// What is known of one cell.
struct MapCellState {
  std::int16_t odds = 0;      ///< log-odds of something being there, or no floor [0.01]
  std::int8_t threshold = 0;  ///< above 0: where it is free, a threshold
  std::int8_t drop_off = 0;   ///< above 0: where it is not free, a drop-off

  bool operator==(const MapCellState& other) const {
    return odds == other.odds && threshold == other.threshold && drop_off == other.drop_off;
  }
  bool operator!=(const MapCellState& other) const { return !(*this == other); }
};

/// How a cell learns from what is seen of it: the parameters in the units of its state.
struct CellRule {
  static constexpr double kStep = 0.01;   ///< log-odds of one unit
  static constexpr int kMostKind = 3;     ///< of the counters: so many looks turn them
  static constexpr int kMostOdds = 3000;  ///< of any parameters

  explicit CellRule(const OccupancyParameters& p)
      : hit(units(p.hit)),
        miss(units(p.miss)),
        most(units(p.most)),
        occupied(units(p.occupied)),
        free(units(p.free)),
        passing(units(p.passing)) {}

  void learn(MapCellState& cell, CellEvidence evidence) const {
    switch (evidence) {
      case CellEvidence::kFree:
        lower(cell);
        count(cell.threshold, -1);
        break;
      case CellEvidence::kThreshold:
        lower(cell);
        count(cell.threshold, +1);
        break;
      case CellEvidence::kDropOff:
        raise(cell, most);
        count(cell.drop_off, +1);
        break;
      case CellEvidence::kPassing:
        raise(cell, cell.odds >= occupied ? most : passing);  // what stays is seen again
        count(cell.drop_off, -1);
        break;
      case CellEvidence::kObstacle:
        raise(cell, most);
        count(cell.drop_off, -1);
        break;
      case CellEvidence::kNone:
        break;
    }
  }

  MapCell judge(const MapCellState& cell) const {
    if (cell.odds >= occupied) return cell.drop_off > 0 ? MapCell::kDropOff : MapCell::kOccupied;
    if (cell.odds > -free) return MapCell::kUnknown;
    return cell.threshold > 0 ? MapCell::kThreshold : MapCell::kFree;
  }

  /// The surest state that is judged as this.
  MapCellState stateOf(MapCell judged) const {
    MapCellState state;
    const bool floor = judged == MapCell::kFree || judged == MapCell::kThreshold;
    if (judged != MapCell::kUnknown) state.odds = static_cast<std::int16_t>(floor ? -most : most);
    if (judged == MapCell::kThreshold) state.threshold = kMostKind;
    if (judged == MapCell::kDropOff) state.drop_off = kMostKind;
    return state;
  }

  int hit, miss, most, occupied, free, passing;

 private:
  static int units(double odds) { return static_cast<int>(std::lround(odds / kStep)); }
  void lower(MapCellState& cell) const {
    cell.odds = static_cast<std::int16_t>(std::max(-most, cell.odds - miss));
  }
  void raise(MapCellState& cell, int cap) const {
    if (cell.odds < cap) cell.odds = static_cast<std::int16_t>(std::min(cap, cell.odds + hit));
  }
  static void count(std::int8_t& counter, int by) {
    counter = static_cast<std::int8_t>(std::clamp(counter + by, -kMostKind, kMostKind));
  }
};

}  // namespace pilothouse
