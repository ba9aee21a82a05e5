#pragma once

#include <string>
#include <vector>

#include "doors/robot_description.hpp"
#include "doors/strict_parameters.hpp"
#include "sim/simulation.hpp"

namespace pilothouse {

/// Everything that the simulator nodelet is told.
struct SimulatorSettings {
  sim::SimRobot robot;
  std::string camera_frame;  ///< optical frame of the pictures
  sim::World world{};
  sim::SimulationParameters parameters{};
  double rate = 1.0;   ///< simulated seconds a second, 0..20; 0: as fast as possible
  bool clock = false;  ///< publishes /clock, which /use_sim_time makes everybody's time
  std::vector<std::string> warnings{};  ///< what the world's file says that is not simulated
};

/// @throws ParameterFault naming each fault, those of the world's file among them.
SimulatorSettings readSimulator(StrictParameters& reader, const RobotDescription& robot);

}  // namespace pilothouse
