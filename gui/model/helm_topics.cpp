#include "gui/model/helm_topics.hpp"

#include <geometry_msgs/TwistStamped.h>
#include <pilothouse/Operator.h>
#include <ros/this_node.h>

namespace pilothouse::gui {

HelmTopics::HelmTopics(const RobotClock& clock)
    : clock_(clock),
      operator_(node_.advertise<Operator>("operator", 5)),
      teleop_(node_.advertise<geometry_msgs::TwistStamped>("cmd_vel/teleop", 2)),
      name_(ros::this_node::getName()) {}

ros::Time HelmTopics::now() const {
  const std::int64_t simulated = clock_.simulated();
  if (simulated >= 0) return ros::Time().fromNSec(static_cast<std::uint64_t>(simulated));
  const ros::WallTime wall = ros::WallTime::now();
  return {wall.sec, wall.nsec};
}

void HelmTopics::beat(const Beat& beat) {
  Operator message;
  message.header.stamp = now();
  message.name = name_;
  message.stop = beat.stop;
  message.driving = beat.driving;
  message.leaving = beat.leaving;
  message.gate_beat = beat.gate_beat;
  operator_.publish(message);
}

void HelmTopics::drive(const Twist2& command) {
  geometry_msgs::TwistStamped message;
  message.header.stamp = now();
  message.header.frame_id = "base_link";
  message.twist.linear.x = command.vx;
  message.twist.linear.y = command.vy;
  message.twist.angular.z = command.w;
  teleop_.publish(message);
}

}  // namespace pilothouse::gui
