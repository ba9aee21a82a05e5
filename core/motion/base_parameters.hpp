#pragma once

#include <string>
#include <vector>

namespace pilothouse {

enum class BaseKind {
  kFourWheelSteered,  ///< four wheels, each steered 360 degrees and driven on its own
  kDifferential,      ///< two driven wheels
  kOmnidirectional,   ///< four mecanum wheels
};

/// What a base can do. Wheels sit at (+-wheelbase / 2, +-track / 2); a differential base has its
/// two at (0, +-track / 2).
struct BaseParameters {
  BaseKind kind = BaseKind::kDifferential;
  double max_speed = 0.6;          ///< of the base [m/s], 0.01..10
  double max_turn_rate = 1.5;      ///< [rad/s], 0.01..10
  double acceleration = 0.6;       ///< [m/s^2], 0.05..20
  double deceleration = 1.2;       ///< that it can always brake with [m/s^2], 0.05..20
  double turn_acceleration = 2.5;  ///< and deceleration in turning [rad/s^2], 0.05..50
  double track = 0.23;             ///< distance of left from right wheels [m], 0.02..5
  double wheelbase = 0.0;  ///< distance of front from rear wheels [m], 0..5; 0: differential only
  double wheel_radius = 0.035;   ///< [m], 0.005..1
  double steering_rate = 3.0;    ///< of a steered wheel [rad/s], 0.1..50
  double lag = 0.05;             ///< time constant of the drives [s], 0..1
  double command_timeout = 0.3;  ///< without a command for this long the base halts [s], 0.05..2
};

/// Every fault, one line each naming key, value and range; empty when sound.
std::vector<std::string> validate(const BaseParameters& parameters);

}  // namespace pilothouse
