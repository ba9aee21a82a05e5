#pragma once

#include <cstdint>

#include "sim/world.hpp"

namespace pilothouse::sim {

struct RandomWorldParameters {
  double robot_radius = 0.33;  ///< circle round the robot's footprint [m], 0.1..0.6
  double clearance = 0.25;     ///< free at least this far round the route's circle [m], 0..1
  int least_people = 0, most_people = 3;  ///< 0..10
  double courtesy = 0.5;       ///< people halt while the robot is this near ahead of them [m]
  double blocked_share = 0.1;  ///< of worlds whose route is closed by an unexpected box, 0..1
  double ramp_share = 0.2;     ///< of worlds with a ramp, 0..1
  double sill_share = 0.3;     ///< of worlds with door sills, 0..1
  double route_length = 6.0;   ///< wished for [m], 2..50
};

struct RandomWorld {
  World world;           ///< with a route `route` that begins at the start
  bool blocked = false;  ///< a box stands on the route and leaves no way along it
};

/// A room or two of random size with furniture, boxes and people. Same seed, same world. Everything
/// that stands in it is at least 7 cm high and 3 cm thick; sills and ramps are drivable.
/// @throws std::invalid_argument naming the parameter that is out of range.
RandomWorld randomWorld(std::uint64_t seed, const RandomWorldParameters& parameters = {});

}  // namespace pilothouse::sim
