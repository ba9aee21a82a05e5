#pragma once

#include <functional>

#include "core/mapping/map_cells.hpp"
#include "sim/world.hpp"

namespace pilothouse::bench {

/// The map that somebody would draw of a world: what is solid between two heights is occupied, all
/// else within is free.
/// @param includes whether a model is in the map; people never are.
MapCells mapOf(const sim::World& world, double robot_height,
               const std::function<bool(const sim::Model&)>& includes);

}  // namespace pilothouse::bench
