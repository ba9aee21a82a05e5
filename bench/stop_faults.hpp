#pragma once

#include <ros/ros.h>

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace pilothouse::bench {

/// A way in which a part of the robot fails.
struct StopFault {
  std::string name;
  std::function<void()> inject;
  std::function<void()> heal;   ///< empty: it heals by being started anew
  bool base_halts = false;      ///< the gate itself fails: the base's own watchdog acts
  bool restarts_robot = false;  ///< what is true of the base begins anew
  std::string victim;           ///< node of the process; empty: none ends
};

/// What the driver of the robot says, that can fall silent or go wrong.
struct StopFaultHooks {
  std::atomic<bool>* command_silent;
  ros::Publisher* limited;  ///< on cmd_vel/limited
};

/// Lets a simulated sensor fail: freeze, stand, drop, delay, none. @throws std::runtime_error.
void failSensor(const std::string& sensor, const std::string& kind, double amount);

/// Every fault of eval stop. @throws std::runtime_error when injected, where the robot does not
/// have the part.
std::vector<StopFault> stopFaults(ros::NodeHandle& handle, const StopFaultHooks& hooks);

}  // namespace pilothouse::bench
