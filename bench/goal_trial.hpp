#pragma once

#include <string>
#include <utility>
#include <vector>

#include "bench/goal_errand.hpp"

namespace pilothouse::bench {

/// What a figure of a run shows.
struct GoalRecord {
  MapCells whole, known, marked;  ///< as it is, as the robot was told, and with what it saw at last
  Goal goal;
  std::vector<Pose2> trail;                          ///< true
  std::vector<std::pair<double, std::string>> said;  ///< by the navigator, when [s]
};

struct GoalResult {
  GoalTask task;
  bool possible = true;          ///< the goal can be reached, things that the map lacks included
  bool reached = false;          ///< it said so
  bool failed = false;           ///< it said so
  std::string text;              ///< what it said last
  double seconds = 0.0;          ///< simulated
  double longest_thought = 0.0;  ///< of the navigator in a step, real time [s]
  double said_after = 0.0;       ///< gave its verdict, that time on top [s]
  double planned = 0.0;          ///< the first way [m]
  double driven = 0.0;           ///< [m]
  /// Of the middle of the circle within the footprint at the planner's clearance, in the room as it
  /// is [m]; infinite where it gets there only nearer to things.
  double shortest = 0.0;
  double off = 0.0;         ///< from the goal at the end [m]
  double turned_off = 0.0;  ///< [rad]
  int contacts = 0;         ///< begun by the robot's motion
  int run_into = 0;         ///< by somebody who walked into the standing robot
  std::string touched;
  unsigned plans = 0;
  double wall_seconds = 0.0;
  GoalRecord record;
};

GoalResult runGoal(const GoalTask& task, double max_seconds);

}  // namespace pilothouse::bench
