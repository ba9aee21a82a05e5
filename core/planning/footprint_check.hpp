#pragma once

#include "core/mapping/map_cells.hpp"
#include "core/motion/footprint.hpp"
#include "core/motion/planar.hpp"
#include "core/planning/cost_field.hpp"

namespace pilothouse {

/// Whether the robot's outline, not only a circle in it, keeps off what is blocked in a map.
class FootprintCheck {
 public:
  /// @param spare kept between outline and blocked cells [m]; they count as discs within them.
  FootprintCheck(Footprint footprint, double spare);

  double inscribed() const { return inscribed_; }          ///< circle about the base's origin [m]
  double circumscribed() const { return circumscribed_; }  ///< [m]
  /// Clearance at which any heading fits [m].
  double ample() const { return circumscribed_ + spare_; }
  /// @param pose in the map's frame; outside the map everything fits.
  bool fits(const CostField& field, const MapCells& map, const Pose2& pose) const;

 private:
  Footprint footprint_;
  double spare_, inscribed_, circumscribed_;
};

}  // namespace pilothouse
