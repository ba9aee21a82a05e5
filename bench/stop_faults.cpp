#include "bench/stop_faults.hpp"

#include <geometry_msgs/Twist.h>
#include <geometry_msgs/TwistStamped.h>
#include <pilothouse/SimulatorFault.h>
#include <signal.h>

#include <limits>
#include <stdexcept>

#include "bench/node_process.hpp"

namespace pilothouse::bench {
namespace {

void signalProcess(pid_t process, int signal, const std::string& node) {
  if (process <= 0 || kill(process, signal) != 0)
    throw std::runtime_error(node + " has no process to be signalled");
}

/// Its watcher (of console and relay: roslaunch) starts it anew.
StopFault killed(const std::string& part, const std::string& node) {
  StopFault fault;
  fault.name = "kill " + part;
  fault.victim = node;
  fault.inject = [node] { signalProcess(processOf(node), SIGKILL, node); };
  return fault;
}

StopFault halted(const std::string& part, const std::string& node) {
  StopFault fault;
  fault.name = "halt " + part;
  const auto process = std::make_shared<pid_t>(0);
  fault.inject = [node, process] {
    *process = processOf(node);  // which a halted process could not say
    signalProcess(*process, SIGSTOP, node);
  };
  fault.heal = [node, process] { signalProcess(*process, SIGCONT, node); };
  return fault;
}

StopFault sensorFault(const std::string& sensor, const std::string& kind, double amount) {
  StopFault fault;
  fault.name = kind + " " + sensor;
  fault.inject = [=] { failSensor(sensor, kind, amount); };
  fault.heal = [sensor] { failSensor(sensor, "none", 0.0); };
  return fault;
}

StopFault secondPublisher(ros::NodeHandle& handle) {
  StopFault fault;
  fault.name = "second publisher";
  const auto publisher = std::make_shared<ros::Publisher>();
  fault.inject = [&handle, publisher] {
    *publisher = handle.advertise<geometry_msgs::Twist>("cmd_vel", 1, true);
    geometry_msgs::Twist twist;
    twist.linear.x = 0.1;
    publisher->publish(twist);  // latched: all get it as soon as they are connected
  };
  fault.heal = [publisher] { publisher->shutdown(); };
  return fault;
}

StopFault silentCommand(std::atomic<bool>* silent) {
  StopFault fault;
  fault.name = "command silent";
  fault.inject = [silent] { *silent = true; };
  fault.heal = [silent] { *silent = false; };
  return fault;
}

StopFault badCommand(ros::Publisher* limited) {
  StopFault fault;
  fault.name = "command not a number";
  fault.inject = [limited] {
    geometry_msgs::TwistStamped twist;
    twist.header.stamp = ros::Time::now();
    twist.twist.linear.x = std::numeric_limits<double>::quiet_NaN();
    limited->publish(twist);
  };
  fault.heal = [] {};
  return fault;
}

}  // namespace

void failSensor(const std::string& sensor, const std::string& kind, double amount) {
  SimulatorFault call;
  call.request.sensor = sensor;
  call.request.kind = kind;
  call.request.amount = static_cast<float>(amount);
  if (!ros::service::call("simulator/fault", call) || !call.response.ok)
    throw std::runtime_error("the simulator's " + sensor + " cannot " + kind + ": " +
                             call.response.message);
}

std::vector<StopFault> stopFaults(ros::NodeHandle& handle, const StopFaultHooks& hooks) {
  std::vector<StopFault> faults;
  const std::pair<const char*, const char*> parts[] = {{"manager", "/pilothouse_manager"},
                                                       {"gate", "/stop_gate"},
                                                       {"console", "/console"},
                                                       {"relay", "/relay"},
                                                       {"robot", "/simulated_robot"}};
  for (const auto& [part, node] : parts) {
    faults.push_back(halted(part, node));
    faults.push_back(killed(part, node));
    for (StopFault* fault : {&faults.back(), &faults[faults.size() - 2]}) {
      fault->base_halts = std::string(part) == "gate";
      fault->restarts_robot = std::string(part) == "robot";
    }
  }
  for (const char* sensor : {"camera", "odometry"}) {
    faults.push_back(sensorFault(sensor, "drop", 0.0));
    faults.push_back(sensorFault(sensor, "freeze", 0.0));
    faults.push_back(sensorFault(sensor, "delay", 1.0));
  }
  faults.push_back(sensorFault("odometry", "stand", 0.0));
  faults.push_back(sensorFault("front", "drop", 0.0));
  faults.push_back(secondPublisher(handle));
  faults.push_back(silentCommand(hooks.command_silent));
  faults.push_back(badCommand(hooks.limited));
  return faults;
}

}  // namespace pilothouse::bench
