/// Stands for a console: says 20 times a second that a person is there, and which of the stop
/// gate's beats has come here.
#include <pilothouse/Operator.h>
#include <pilothouse/StopState.h>
#include <ros/ros.h>

int main(int argc, char** argv) {
  ros::init(argc, argv, "operator_stand_in");
  ros::NodeHandle handle;
  pilothouse::Operator message;
  message.name = "stand-in";
  ros::Publisher out = handle.advertise<pilothouse::Operator>("operator_sent", 10);
  const ros::Subscriber state = handle.subscribe<pilothouse::StopState>(
      "stop_state", 10,
      [&message](const pilothouse::StopStateConstPtr& newest) { message.gate_beat = newest->beat; },
      ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay());
  const ros::SteadyTimer timer =
      handle.createSteadyTimer(ros::WallDuration(0.05), [&](const ros::SteadyTimerEvent&) {
        message.header.stamp = ros::Time::now();
        out.publish(message);
      });
  ros::spin();
  return 0;
}
