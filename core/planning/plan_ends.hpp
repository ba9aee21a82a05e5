#pragma once

#include <optional>

#include "core/planning/footprint_check.hpp"
#include "core/planning/grid_search.hpp"
#include "core/planning/no_way.hpp"

namespace pilothouse {

struct PlanRequest {
  Pose2 start;                     ///< map frame
  Eigen::Vector2d goal{0.0, 0.0};  ///< map frame [m]
  std::optional<double> heading;   ///< at the goal; none: as it comes [rad]
};

/// The cells that a search runs between.
struct PlanEnds {
  NoWay why = NoWay::kNone;  ///< why there can be none
  Cell start, goal;
  bool has_start = false;
  /// The robot stands too near to something: `start` is the nearest cell that is free, straight.
  bool escaped = false;
};

/// @param escape how far that cell may be from the robot [m].
PlanEnds findEnds(const CostField& field, const MapCells& map, const FootprintCheck& check,
                  const PlanRequest& request, double escape);

}  // namespace pilothouse
