#pragma once

#include "doors/robot_description.hpp"
#include "sim/sim_robot.hpp"

namespace pilothouse {

/// The robot of a file as the simulator wants it.
sim::SimRobot simRobotOf(const RobotDescription& robot);

}  // namespace pilothouse
