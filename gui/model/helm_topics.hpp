#pragma once

#include <ros/node_handle.h>

#include <string>

#include "gui/model/helm.hpp"
#include "gui/model/robot_clock.hpp"

namespace pilothouse::gui {

/// The helm's messages on `operator` and `cmd_vel/teleop`, by a node handle of their own. roscpp
/// only queues what is published, so nothing here waits for the network.
class HelmTopics : public HelmOutput {
 public:
  /// On the link thread: advertising asks the master.
  explicit HelmTopics(const RobotClock& clock);
  void beat(const Beat& beat) override;
  void drive(const Twist2& command) override;

 private:
  ros::Time now() const;

  const RobotClock& clock_;
  ros::NodeHandle node_;
  ros::Publisher operator_, teleop_;
  std::string name_;
};

}  // namespace pilothouse::gui
