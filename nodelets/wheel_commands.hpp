#pragma once

#include <ros/node_handle.h>
#include <sensor_msgs/JointState.h>

#include <string>
#include <utility>

#include "core/motion/kinematics.hpp"

namespace pilothouse {

/// Says on wheel_commands, while somebody listens, what each wheel would have to do for a twist:
/// NAME_wheel with its velocity [rad/s], of steered ones NAME_steering with its position [rad].
class WheelCommands {
 public:
  WheelCommands(ros::NodeHandle& handle, const BaseParameters& base, std::string frame)
      : kinematics_(base),
        radius_(base.wheel_radius),
        frame_(std::move(frame)),
        publisher_(handle.advertise<sensor_msgs::JointState>("wheel_commands", 2)) {}

  void publish(const Twist2& twist) {
    states_ = kinematics_.inverse(twist, states_);
    if (publisher_.getNumSubscribers() == 0) return;
    sensor_msgs::JointState message;
    message.header.stamp = ros::Time::now();
    message.header.frame_id = frame_;
    for (std::size_t i = 0; i < kinematics_.wheels().size(); ++i) {
      const std::string& name = kinematics_.wheels()[i].name;
      add(message, name + "_wheel", 0.0, states_[i].speed / radius_);
      if (kinematics_.steered()) add(message, name + "_steering", states_[i].angle, 0.0);
    }
    publisher_.publish(message);
  }

 private:
  static void add(sensor_msgs::JointState& message, const std::string& name, double position,
                  double velocity) {
    message.name.push_back(name);
    message.position.push_back(position);
    message.velocity.push_back(velocity);
  }

  Kinematics kinematics_;
  double radius_;
  std::string frame_;
  ros::Publisher publisher_;
  WheelStates states_;
};

}  // namespace pilothouse
