#pragma once

#include <string>

#include "core/mapping/map_cells.hpp"
#include "core/planning/cost_field.hpp"
#include "core/planning/reach.hpp"

namespace pilothouse {

/// Why there is no path.
enum class NoWay {
  kNone,                ///< there is one
  kNoMap,               ///< no map has come yet
  kNotFinite,           ///< start or goal is not a number
  kStartOutside,        ///< the robot stands outside the map
  kStartBlocked,        ///< it stands among things, and cannot get away from them
  kGoalOutside,         ///< the goal lies outside the map
  kGoalOccupied,        ///< something stands there
  kGoalDropOff,         ///< a step down is there
  kGoalUnknown,         ///< nobody has seen the floor there, and it is not to be trusted
  kGoalTight,           ///< the robot does not fit there
  kGoalHeadingTight,    ///< it does, but not with the heading asked for
  kWalledOff,           ///< things stand all round the goal, or the robot
  kTooNarrow,           ///< there is a way, but the robot does not fit through
  kOnlyOverDropOff,     ///< only down a step
  kOnlyThroughUnknown,  ///< only over floor that nobody has seen
};

/// In words, for a person: what and why.
const char* textOf(NoWay why);

/// What keeps one cell from others in a map whose search found no way: the least of the evils that
/// a way would have to pass, in the order unknown floor, narrow places, drop-offs, things. It is
/// the same both ways; quicker from where less can be reached.
NoWay whatParts(const MapCells& map, const CostField& field, const Cell& from, const Reach& to);

}  // namespace pilothouse
