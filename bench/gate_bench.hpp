#pragma once

#include <cmath>
#include <limits>

#include "core/motion/stop_gate.hpp"

namespace pilothouse {

/// A robot in good order round the stop gate, step by step: what a test wants to fail, it sets.
class GateBench {
 public:
  static constexpr double kPeriod = 0.02;
  static constexpr double kRosAhead = 1.7e9;   // of ROS time before the steady clock [s]
  static constexpr double kConsoleAhead = 42;  // of the console's clock before ROS time [s]

  GateParameters parameters;
  GateState state{1000};
  GateInputs in;
  GateOutput out;

  // What still comes in.
  bool perception = true, odometry = true, limiter = true, command = true;
  bool frozen = false;  ///< odometry comes, with new stamps, but says the same
  bool stands = false;  ///< odometry says that the robot does not move
  bool console = false, console_hears = true;
  Twist2 wanted{0.3, 0.0, 0.1};
  CommandSource source = CommandSource::kTask;
  double link_delay = 0.0;  ///< from and to the console, in steps' multiples [s]
  double now = 100.0;       ///< steady [s]

  GateBench() { in.now = {now, now + kRosAhead}; }

  double ros() const { return now + kRosAhead; }
  double consoleClock() const { return ros() + kConsoleAhead; }

  /// One step of the gate, 20 ms later.
  const GateOutput& tick(double dt = kPeriod) {
    now += dt;
    in.now = {now, ros()};
    publish();
    out = step(parameters, state, in);
    if (console_hears) heard_ = out.beat;
    return out;
  }
  const GateOutput& run(double seconds) {
    for (double t = 0.0; t < seconds - 1e-9; t += kPeriod) tick();
    return out;
  }
  /// Runs until everything has come in, and arms. @return whether it is armed.
  bool arm() {
    ++in.arm_requests;
    return tick().status != GateStatus::kStopped;
  }
  bool armed() {
    run(0.2);
    return arm();
  }
  /// Steps until the command is zero. @return the time it took [s]; more than a second: never.
  double timeToZero() {
    const double from = now;
    while (now - from < 1.0)
      if (tick().command.zero()) break;
    return now - from;
  }
  void say(bool stop, bool driving, bool leaving) {
    ConsoleMessage& m = in.consoles[0];
    m.slot_use = 1;
    ++m.count;
    if (stop) ++m.stops;
    m.stamp = consoleClock();
    m.arrival = now;
    m.gate_beat = heard_;
    m.stop = stop;
    m.driving = driving;
    m.leaving = leaving;
  }

 private:
  void publish() {
    if (odometry) {
      static_cast<Arrival&>(in.odometry) = {ros(), now};
      if (!frozen) in.odometry.pose.x = now;
      in.odometry.twist = stands ? Twist2{} : out.command;
    }
    if (perception) perception_stamp_ = ros() - 0.06;
    if (console) say(false, source == CommandSource::kTeleop, false);
    if (command) {
      static_cast<Arrival&>(in.command) = {
          source == CommandSource::kTeleop ? consoleClock() : ros(), now};
      in.command.twist = wanted;
    }
    if (!limiter) return;
    static_cast<Arrival&>(in.limit) = {ros(), now};
    in.limit.perception_stamp = perception_stamp_;
    in.limit.command_stamp = in.command.stamp;
    in.limit.source = source;
    in.limit.wanted = wanted.finite() ? std::abs(wanted.vx) + std::abs(wanted.w) : NAN;
  }

  std::uint32_t heard_ = 0;
  double perception_stamp_ = 0.0;
};

}  // namespace pilothouse
