#pragma once

#include <functional>
#include <vector>

#include "bench/convex_shape.hpp"
#include "core/mapping/map_cells.hpp"
#include "sim/world.hpp"

namespace pilothouse::bench {

/// The map that somebody would draw of a world: what is solid between two heights is occupied, all
/// else within is free.
/// @param includes whether a model is in the map; people never are.
MapCells mapOf(const sim::World& world, double clear_height,
               const std::function<bool(const sim::Model&)>& includes);

/// The same as shapes, exactly: what lies between those heights, seen from above. Convex parts are
/// one shape, of others each triangle is.
std::vector<ConvexShape> shapesOf(const sim::World& world, double clear_height,
                                  const std::function<bool(const sim::Model&)>& includes);

}  // namespace pilothouse::bench
