#pragma once

#include <string>
#include <vector>

namespace pilothouse {

/// What keeps the robot off things. What an operator must know is above the line.
struct AvoidanceParameters {
  double stop_distance =
      0.25;        ///< free way before the footprint at which the robot stands [m], 0.02..5
  double n = 1.0;  ///< power limit P(d) = min(1, k d^n): its exponent, 0.2..5
  double k = 1.2;  ///< and its factor [1/m^n]; d beyond the stop distance for obstacles, 0.05..20
  double margin = 0.20;  ///< what is this far beside the way is a potential obstacle [m], 0..2
  double beside_speed = 0.10;     ///< potential obstacles never slow the robot below [m/s], 0.01..2
  double threshold_speed = 0.15;  ///< over thresholds [m/s], 0.01..5
  double unseen_speed = 0.15;     ///< where nothing has looked; 0: never go there [m/s], 0..5
  double memory = 600.0;          ///< what left the view is remembered for [s], 0..3600
  // ---- advanced
  double latency = 0.15;         ///< from the world to the wheels, for the braking bound [s], 0..2
  double turn_clearance = 0.03;  ///< stop distance when turning in place [m], 0..2
  int confirm_frames = 2;        ///< a lone speckle counts when seen in so many ..., 1..confirm_of
  int confirm_of = 3;            ///< ... of so many frames, 1..8
  double near_distance = 0.5;    ///< nearer than this to the footprint it counts at once [m], 0..5
  double look_ahead = 3.0;       ///< the path is swept this far [m], 0.2..20
  double input_timeout = 0.3;    ///< older inputs mean stop [s], 0.05..2
  double acceleration = 0.5;     ///< of the limited command [m/s^2], 0.05..20
  double jerk = 2.0;             ///< [m/s^3], 0.1..200
  double kp = 0.4, ki = 0.8, kd = 0.0;  ///< PID on path speed [1, 1/s, s], 0..10
};

/// Every fault, one line each naming key, value and range; empty when sound.
std::vector<std::string> validate(const AvoidanceParameters& parameters);

}  // namespace pilothouse
