#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "bench/stop_faults.hpp"
#include "bench/stop_rig.hpp"

namespace pilothouse::bench {

/// What came of one fault.
struct StopResult {
  std::string fault;
  std::string cause;     ///< in the gate's words
  double to_zero = 0.0;  ///< from the fault to the command (or the base's own halt) [s]; NaN: never
  int commands_after = 0;  ///< that were not zero, after it and before arming
  /// Of a gate that was halted: the command that it had sent before may arrive when it wakes up.
  int in_flight = 0;
  double moved = 0.0;     ///< of the base between its standstill and arming [m]
  double up_again = 0.0;  ///< until it could be armed: from the fault where something had to start
                          ///< anew, else from its end [s]
};

/// Drives, lets the fault happen at a random instant, watches, and leaves the robot driving again.
StopResult tryFault(StopRig& rig, const StopFault& fault, std::mt19937& random);

/// What came of an obstacle that appears.
struct AppearanceResult {
  bool stopped = false;     ///< the gate, which no obstacle stops: `resumed` means nothing
  bool beforehand = false;  ///< and before the picture: `to_zero` means nothing either
  std::string cause;        ///< of its stop, in the gate's words
  double to_zero = 0.0;     ///< from the depth picture's stamp to the zero command [s]; NaN: never
  double from_place = 0.0;  ///< the same from when it was put there [s]
  int commands_after = 0;   ///< that were not zero, from that until the box was taken away
  std::uint32_t contacts = 0;
  double resumed = 0.0;  ///< from when it was taken away to the first command [s]; NaN: never
  std::string held_by;   ///< where it did not resume: the gate's words, and the limit
  double speed = 0.0;    ///< of the robot when it appeared [m/s]
};

/// Puts the box before the driving robot, and takes it away again.
AppearanceResult tryAppearance(StopRig& rig, std::mt19937& random);

}  // namespace pilothouse::bench
