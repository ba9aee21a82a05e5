#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "core/motion/planar.hpp"

namespace pilothouse::gui {

// What the messages of the driving side say, checked: every number finite unless its comment says
// otherwise, every text short and printable.

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// In the order of SpeedLimit.cause.
enum class LimitCause : std::uint8_t {
  kFree,
  kObstacle,
  kPotential,
  kBraking,
  kThreshold,
  kUnseen,
  kStale,
  kBadCommand,
};
constexpr int kLimitCauses = 8;

/// The speed limiter's word. Speeds are path speeds [m/s].
struct LimitReading {
  LimitCause cause = LimitCause::kFree;
  std::string sensor, source;
  double distance = kUnknown;         ///< free way to the cause [m]; NaN: none
  double x = kUnknown, y = kUnknown;  ///< of the cause, base frame [m]; NaN: none
  double limit = 0.0;                 ///< may be infinite
  double wanted = 0.0, limited = 0.0;
  double measured = kUnknown;            ///< NaN: unknown
  double obstacle_distance = kUnknown;   ///< [m]; infinite: none
  double potential_distance = kUnknown;  ///< [m]; infinite: none
  double input_age = kUnknown;           ///< of the stale input [s]; NaN: never came
};

/// In the order of StopState.state and StopState.cause.
enum class GatePhase : std::uint8_t { kRunning, kIdle, kStopped };
enum class StopCause : std::uint8_t {
  kNone,
  kNotArmed,
  kOperator,
  kStalePerception,
  kStaleOdometry,
  kStaleCommand,
  kOperatorGone,
  kSecondPublisher,
  kBadCommand,
  kStaleLimit,
  kClock,
};

/// The stop gate's word.
struct StopReading {
  std::uint32_t beat = 0;
  GatePhase phase = GatePhase::kStopped;
  StopCause cause = StopCause::kNone;
  std::string text;
  bool can_arm = false;
  std::string obstacle_to_arming;
  double perception_age = kUnknown, odometry_age = kUnknown;  ///< [s]; may be infinite
  Twist2 command;                                             ///< as it went to the base
};

struct WheelReading {
  std::string name;  ///< without _wheel
  double rate;       ///< [rad/s]; NaN: not told
};

/// A ranger's newest measurement.
struct RangeReading {
  std::string name;
  double range = kUnknown;     ///< [m]; infinite: nothing within max
  double max = 0.0;            ///< [m]
  double field_of_view = 0.0;  ///< [rad]
  double at = 0.0;             ///< steady arrival [s]
};

struct ContactsReading {
  std::uint32_t count = 0;
  std::vector<std::string> touching;
  double at = -1e9;  ///< steady arrival [s]
};

/// In the order of RouteState.state.
enum class RoutePhase : std::uint8_t { kIdle, kDriving, kWaiting, kReached, kRefused };

struct RouteReading {
  RoutePhase phase = RoutePhase::kIdle;
  std::uint32_t target = 0, points = 0;
  double distance_left = 0.0;  ///< [m]
  std::string text;
  double at = -1e9;  ///< steady arrival [s]
};

/// A wish to drive as it was sent on cmd_vel/teleop or cmd_vel/task.
struct WantedReading {
  Twist2 twist;
  double at = -1e9;  ///< steady arrival [s]
};

}  // namespace pilothouse::gui
