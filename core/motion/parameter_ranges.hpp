#pragma once

#include "core/motion/avoidance_parameters.hpp"
#include "core/motion/base_parameters.hpp"

namespace pilothouse {

/// Calls visit(key, value, low, high) for every number of the parameters: the one place that knows
/// their names and ranges. `p` may be const.
template <class Parameters, class Visit>
void forEachBaseParameter(Parameters& p, Visit visit) {
  visit("max_speed", p.max_speed, 0.01, 10.0);
  visit("max_turn_rate", p.max_turn_rate, 0.01, 10.0);
  visit("acceleration", p.acceleration, 0.05, 20.0);
  visit("deceleration", p.deceleration, 0.05, 20.0);
  visit("turn_acceleration", p.turn_acceleration, 0.05, 50.0);
  visit("track", p.track, 0.02, 5.0);
  visit("wheelbase", p.wheelbase, 0.0, 5.0);
  visit("wheel_radius", p.wheel_radius, 0.005, 1.0);
  visit("steering_rate", p.steering_rate, 0.1, 50.0);
  visit("lag", p.lag, 0.0, 1.0);
  visit("command_timeout", p.command_timeout, 0.05, 2.0);
}

/// The same for AvoidanceParameters; confirm_frames and confirm_of are ints.
template <class Parameters, class Visit>
void forEachAvoidanceParameter(Parameters& p, Visit visit) {
  visit("stop_distance", p.stop_distance, 0.02, 5.0);
  visit("n", p.n, 0.2, 5.0);
  visit("k", p.k, 0.05, 20.0);
  visit("margin", p.margin, 0.0, 2.0);
  visit("beside_speed", p.beside_speed, 0.01, 2.0);
  visit("threshold_speed", p.threshold_speed, 0.01, 5.0);
  visit("unseen_speed", p.unseen_speed, 0.0, 5.0);
  visit("memory", p.memory, 0.0, 3600.0);
  visit("latency", p.latency, 0.0, 2.0);
  visit("turn_clearance", p.turn_clearance, 0.0, 2.0);
  visit("confirm_frames", p.confirm_frames, 1, 8);
  visit("confirm_of", p.confirm_of, 1, 8);
  visit("near_distance", p.near_distance, 0.0, 5.0);
  visit("look_ahead", p.look_ahead, 0.2, 20.0);
  visit("input_timeout", p.input_timeout, 0.05, 2.0);
  visit("acceleration", p.acceleration, 0.05, 20.0);
  visit("jerk", p.jerk, 0.1, 200.0);
  visit("kp", p.kp, 0.0, 10.0);
  visit("ki", p.ki, 0.0, 10.0);
  visit("kd", p.kd, 0.0, 10.0);
}

}  // namespace pilothouse
