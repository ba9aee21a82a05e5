#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <string>

#include "core/motion/speed_limiter.hpp"
#include "nodelets/command_choice.hpp"

namespace pilothouse {

/// Stamps of the newest inputs [s]; not above 0: never came.
struct AvoidanceStamps {
  double perception = 0.0;  ///< of the oldest sensor that safety needs
  double odometry = 0.0;
  std::string oldest;  ///< that sensor's name
  bool odometry_stale = false;
};

/// What the avoidance nodelet publishes: objects/merged, objects/filtered (while somebody listens),
/// speed_limit, cmd_vel/limited.
class AvoidanceOutputs {
 public:
  AvoidanceOutputs(ros::NodeHandle& handle, std::string base_frame);
  /// @param now the instant of the step [s]
  void publish(double now, const LimitedCommand& limited, const CommandChoice::Wish& wish,
               const AvoidanceStamps& stamps, const Surroundings& surroundings);
  /// Objects with their relevance.
  void publish(const Surroundings& surroundings);

 private:
  std::string base_frame_;
  ros::Publisher command_, limit_, merged_, filtered_;
};

}  // namespace pilothouse
