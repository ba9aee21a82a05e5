#pragma once

#include <cstdint>
#include <optional>

#include "core/mapping/map_cells.hpp"
#include "core/navigation/goal_navigator.hpp"
#include "doors/robot_description.hpp"
#include "sim/random_world.hpp"

namespace pilothouse::bench {

/// One run of the campaign: a random furnished room, a goal in it, one of the robots.
struct GoalTask {
  int run = 0;
  std::uint64_t seed = 0;
  const RobotDescription* robot = nullptr;
  bool still = false;        ///< nobody walks and the map knows everything: lengths are judged
  bool unreachable = false;  ///< the goal is where the robot cannot get to
};

/// The room as it is, as the robot knows it, and where it shall go.
struct Errand {
  MapCells whole, known;
  Goal goal;
  bool possible = false;  ///< things that the map lacks included
  double shortest = 0.0;  ///< [m], see GoalResult
};

sim::RandomWorld worldOf(const GoalTask& task);
/// Nothing where no goal was found in the room.
std::optional<Errand> errandOf(const GoalTask& task, const sim::World& world);

}  // namespace pilothouse::bench
