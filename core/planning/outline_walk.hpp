#pragma once

#include <optional>

#include "core/motion/route.hpp"
#include "core/planning/footprint_check.hpp"

namespace pilothouse {

/// How a base goes along a route.
struct OutlineWalk {
  double from = 0.0;         ///< heading where it starts [rad]
  bool turns = true;         ///< into the way, else it keeps the heading
  std::optional<double> to;  ///< heading that it turns to at the end [rad]
};

/// The first pose on the rounded route at which the outline would touch. What touches where it
/// starts is not the way's fault.
std::optional<Pose2> firstTouch(const FootprintCheck& check, const CostField& field,
                                const MapCells& map, const Route& route, const OutlineWalk& walk);

}  // namespace pilothouse
