#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/motion/planar.hpp"
#include "doors/robot_description.hpp"

namespace pilothouse::bench {

/// One run of the campaign: a random world, a route in it, one of the robots.
struct DriveTask {
  int run = 0;
  std::uint64_t seed = 0;
  const RobotDescription* robot = nullptr;
};

struct DriveResult {
  DriveTask task;
  bool blocked = false;  ///< a box stands on the route: it cannot be driven to its end
  bool reached = false;
  double seconds = 0.0;       ///< until reached or given up [s]
  double free_seconds = 0.0;  ///< of the same route with nothing that limits, 0: not reached either
  double driven = 0.0;        ///< way [m]
  double wanting = 0.0;       ///< time that the robot wanted to drive [s]
  double false_stop = 0.0;    ///< of that, held with nothing near in its way [s]
  int contacts = 0;           ///< begun by the robot's motion
  int run_into = 0;           ///< by somebody who walked into the standing robot
  std::string touched;        ///< names of what was touched
  double too_near = 0.0;      ///< farthest past the stop distance, still moving towards it [m]
  double too_near_time = 0.0;  ///< when [s]
  std::string too_near_to;
  double wall_seconds = 0.0;  ///< the computer's
  std::string last_text;      ///< why it did not get on
};

/// @param max_seconds simulated; then the run counts as not reached.
DriveResult runDrive(const DriveTask& task, double max_seconds);

}  // namespace pilothouse::bench
