#include "core/planning/no_way.hpp"

#include <array>
#include <vector>

namespace pilothouse {
namespace {

enum Evil : std::uint8_t { kNoEvil, kUnknownFloor, kNarrow, kStep, kThing, kEvils };

/// A cell that is free but too near to something is narrow; too near only to unknown floor it is as
/// bad as that.
Evil evilOf(const MapCells& map, const CostField& field, const Cell& cell) {
  if (field.weight(cell.x, cell.y) != 0) return kNoEvil;
  switch (map.at(cell.x, cell.y)) {
    case MapCell::kOccupied:
      return kThing;
    case MapCell::kDropOff:
      return kStep;
    case MapCell::kUnknown:
      return kUnknownFloor;
    default:
      break;
  }
  const int reach = static_cast<int>(field.least() / map.cell_size + 1.5);
  bool step = false;
  for (int y = cell.y - reach; y <= cell.y + reach; ++y) {
    for (int x = cell.x - reach; x <= cell.x + reach; ++x) {
      const MapCell near = map.at(x, y);
      const int square = (x - cell.x) * (x - cell.x) + (y - cell.y) * (y - cell.y);
      if (square > reach * reach) continue;
      if (near == MapCell::kOccupied) return kNarrow;
      step = step || near == MapCell::kDropOff;
    }
  }
  return step ? kStep : kUnknownFloor;
}

NoWay reasonOf(Evil worst) {
  switch (worst) {
    case kUnknownFloor:
      return NoWay::kOnlyThroughUnknown;
    case kNarrow:
      return NoWay::kTooNarrow;
    case kStep:
      return NoWay::kOnlyOverDropOff;
    default:
      return NoWay::kWalledOff;
  }
}

}  // namespace

const char* textOf(NoWay why) {
  switch (why) {
    case NoWay::kNone:
      return "there is a way";
    case NoWay::kNoMap:
      return "there is no map yet";
    case NoWay::kNotFinite:
      return "start or goal is not a finite number";
    case NoWay::kStartOutside:
      return "the robot stands outside the map";
    case NoWay::kStartBlocked:
      return "the robot stands too near to things all round it";
    case NoWay::kGoalOutside:
      return "the goal lies outside the map";
    case NoWay::kGoalOccupied:
      return "something stands at the goal";
    case NoWay::kGoalDropOff:
      return "the goal is at a drop-off";
    case NoWay::kGoalUnknown:
      return "nobody has seen the floor at the goal";
    case NoWay::kGoalTight:
      return "the goal is too near to something: the robot does not fit there";
    case NoWay::kGoalHeadingTight:
      return "the robot does not fit at the goal with that heading";
    case NoWay::kWalledOff:
      return "things stand between the robot and the goal on every way";
    case NoWay::kTooNarrow:
      return "the only ways to the goal are too narrow for the robot";
    case NoWay::kOnlyOverDropOff:
      return "the only ways to the goal lead over a drop-off";
    case NoWay::kOnlyThroughUnknown:
      return "the only ways to the goal lead over floor that nobody has seen";
  }
  return "?";
}

/// Spreads over all that a little evil opens, then over what the next one does.
NoWay whatParts(const MapCells& map, const CostField& field, const Cell& from, const Reach& to) {
  std::array<std::vector<Cell>, kEvils> waiting;
  std::vector<std::uint8_t> seen(map.cells.size(), 0);
  const auto meet = [&](const Cell& cell, int worst) {
    if (!map.contains(cell.x, cell.y) || seen[map.index(cell.x, cell.y)] != 0) return;
    seen[map.index(cell.x, cell.y)] = 1;
    const int evil = evilOf(map, field, cell);
    waiting[static_cast<std::size_t>(evil > worst ? evil : worst)].push_back(cell);
  };
  meet(from, 0);
  for (int worst = 0; worst < kEvils; ++worst) {
    auto& cells = waiting[static_cast<std::size_t>(worst)];
    while (!cells.empty()) {
      const Cell cell = cells.back();
      cells.pop_back();
      if (to.holds(field, cell)) return reasonOf(static_cast<Evil>(worst));
      meet({cell.x + 1, cell.y}, worst);
      meet({cell.x - 1, cell.y}, worst);
      meet({cell.x, cell.y + 1}, worst);
      meet({cell.x, cell.y - 1}, worst);
    }
  }
  return NoWay::kWalledOff;
}

}  // namespace pilothouse
