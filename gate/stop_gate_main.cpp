#include <ros/ros.h>
#include <signal.h>

#include <csignal>

#include "doors/respawned.hpp"
#include "doors/robot_description.hpp"
#include "gate/gate_process.hpp"

namespace pilothouse {
namespace {

GateParameters readParameters(ros::NodeHandle& handle) {
  GateParameters parameters;
  StrictParameters own(ros::NodeHandle("~"));
  forEachGateParameter(parameters, [&own](const char* key, double& value, double low, double high) {
    own.read(key, value, low, high);
  });
  own.read("require_operator", parameters.require_operator);
  own.finish();
  StrictParameters robot(ros::NodeHandle(handle, "robot"));
  const BaseParameters drive = readRobot(robot).drive;
  parameters.max_speed = drive.max_speed;
  parameters.max_turn_rate = drive.max_turn_rate;
  if (drive.kind == BaseKind::kFourWheelSteered)
    parameters.steering_time = 1.6 / drive.steering_rate;  // a quarter of a turn
  parameters.can_go_sideways = drive.kind != BaseKind::kDifferential;
  return parameters;
}

volatile std::sig_atomic_t end_asked = 0;

/// Until the gate stands, a signal ends the process at once; then it may still publish a last zero.
void waitForTheEnd() {
  struct sigaction action {};
  action.sa_handler = [](int) { end_asked = 1; };
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  while (ros::ok() && end_asked == 0) ros::WallDuration(0.05).sleep();
}

int run(int argc, char** argv) {
  ros::init(argc, argv, "stop_gate", ros::init_options::NoSigintHandler);
  try {
    ros::NodeHandle handle;
    const GateParameters parameters = readParameters(handle);
    const GateProcess gate(parameters, handle);
    waitForTheEnd();
  } catch (const ParameterFault&) {
    return kRefused;  // each fault was logged
  }
  ros::shutdown();
  return 0;
}

}  // namespace
}  // namespace pilothouse

int main(int argc, char** argv) {
  return pilothouse::runRespawned(argc, argv, [&] { return pilothouse::run(argc, argv); });
}
