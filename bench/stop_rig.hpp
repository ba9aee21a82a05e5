#pragma once

#include <ros/ros.h>

#include <atomic>
#include <memory>
#include <string>
#include <thread>

#include "bench/base_watch.hpp"
#include "bench/own_master.hpp"

namespace pilothouse::bench {

/// A robot of real processes on a master of its own, that drives in a circle, and is watched.
class StopRig {
 public:
  /// Call before any other ROS. @throws std::runtime_error when it does not come up.
  StopRig(int argc, char** argv, std::uint64_t seed);
  ~StopRig();
  StopRig(const StopRig&) = delete;
  StopRig& operator=(const StopRig&) = delete;

  BaseWatch& watch() { return *watch_; }
  ros::NodeHandle& handle() { return *handle_; }
  ros::Publisher& limited() { return limited_; }
  std::atomic<bool>& commandSilent() { return silent_; }

  /// Waits until the gate says that it may be armed, or still is. @return the time it took [s].
  /// @throws std::runtime_error after 20 s, with the gate's words.
  double waitUntilUp();
  /// Arms, and waits until the robot drives; again where it is stopped by something that nobody
  /// made fail. @throws std::runtime_error, with the gate's words.
  void armAndDrive();
  /// Waits until the robot drives, and arms it if it was stopped.
  void waitUntilDriving();
  int falseStops() const { return false_stops_; }

 private:
  void drive();
  void endLaunch();
  bool driving(double seconds);

  OwnMaster master_;
  std::string world_;
  pid_t launch_ = -1;
  std::unique_ptr<ros::NodeHandle> handle_;
  std::unique_ptr<ros::AsyncSpinner> spinner_;
  std::unique_ptr<BaseWatch> watch_;
  ros::Publisher task_, limited_;
  std::atomic<bool> silent_{false}, ending_{false};
  int false_stops_ = 0;
  std::thread driver_;
};

}  // namespace pilothouse::bench
