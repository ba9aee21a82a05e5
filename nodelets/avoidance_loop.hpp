#pragma once

#include <geometry_msgs/TwistStamped.h>
#include <nav_msgs/Odometry.h>
#include <pilothouse/FloorGrid.h>
#include <ros/node_handle.h>
#include <sensor_msgs/Range.h>

#include <string>
#include <vector>

#include "core/motion/object_merger.hpp"
#include "core/motion/speed_limiter.hpp"
#include "doors/frozen_grid.hpp"
#include "doors/robot_description.hpp"
#include "nodelets/avoidance_outputs.hpp"
#include "nodelets/command_choice.hpp"

namespace pilothouse {

/// Merger, limiter and choice of the command, fed by messages: the avoidance nodelet without its
/// subscriptions. Each take() returns why it refused the message; empty: it did not. One thread at
/// a time.
class AvoidanceLoop {
 public:
  struct Frames {
    std::string base = "base_link";
    std::string odometry = "odom";
  };
  AvoidanceLoop(const RobotDescription& robot, ros::NodeHandle& handle, const Frames& frames);
  /// @throws std::invalid_argument listing every fault; then the old ones stay.
  void setParameters(const AvoidanceParameters& parameters);
  const AvoidanceParameters& parameters() const { return limiter_.parameters(); }

  std::string take(const FloorGrid& grid);
  std::string take(const nav_msgs::Odometry& odometry);
  std::string take(std::size_t ranger, const sensor_msgs::Range& range);
  std::string take(CommandChoice::Source source, const geometry_msgs::TwistStamped& command);
  /// While the gate lets nothing pass the limited speed stays at zero, so that the robot starts
  /// gently when it is armed.
  void stopped(bool stopped) { stopped_ = stopped; }

  /// Decides and publishes; the time since the last step is taken from the steady clock.
  void step();

 private:
  void clear();
  void noticeTime(double now);
  AvoidanceStamps stamps(double now) const;

  Frames frames_;
  ObjectMerger merger_;
  SpeedLimiter limiter_;
  AvoidanceOutputs outputs_;
  CommandChoice commands_;
  std::vector<CellClass> classes_;
  FrozenGrid frozen_;
  Surroundings surroundings_;
  double odometry_stamp_ = 0.0;
  Twist2 measured_;
  double last_now_ = 0.0, last_step_ = 0.0, last_objects_ = 0.0;
  bool new_grid_ = false;
  bool stopped_ = false;
};

}  // namespace pilothouse
