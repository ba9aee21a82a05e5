#pragma once

#include <string>
#include <vector>

#include "core/motion/path_tracking.hpp"
#include "core/motion/route.hpp"

namespace pilothouse {

/// What a planner makes of floor that nobody has seen.
enum class UnknownFloor {
  kOptimistic,  ///< crossed at a cost: it will be seen on the way
  kNever,       ///< as if something stood there
};

struct PlanningParameters {
  double clearance = 0.10;      ///< kept between footprint and things at least [m], 0..1
  double wish = 0.35;           ///< so far from the footprint things cost nothing [m], 0..3
  double closeness = 0.5;       ///< a metre at the least clearance costs so much more, 0..6
  double threshold_cost = 2.0;  ///< and one over a threshold, 0..6
  double unknown_cost = 0.5;    ///< and one where nobody has looked, 0..6
  double escape = 0.6;  ///< starting too near to something it goes at most so far to get away
                        ///< [m], 0..5
  UnknownFloor unknown = UnknownFloor::kOptimistic;
  HeadingMode heading = HeadingMode::kFree;  ///< of bases that can move sideways
  CornerParameters corners;                  ///< as the motion executor has them
};

/// Calls visit(key, value, low, high) for every number of the parameters.
template <class Parameters, class Visit>
void forEachPlanningParameter(Parameters& p, Visit visit) {
  visit("clearance", p.clearance, 0.0, 1.0);
  visit("wish", p.wish, 0.0, 3.0);
  visit("closeness", p.closeness, 0.0, 6.0);
  visit("threshold_cost", p.threshold_cost, 0.0, 6.0);
  visit("unknown_cost", p.unknown_cost, 0.0, 6.0);
  visit("escape", p.escape, 0.0, 5.0);
  visit("corner_radius", p.corners.radius, 0.0, 10.0);
  visit("max_cut", p.corners.max_cut, 0.0, 5.0);
}

/// Every fault, one line each naming key, value and range; empty when sound.
std::vector<std::string> validate(const PlanningParameters& parameters);

}  // namespace pilothouse
