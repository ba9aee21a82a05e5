#pragma once

#include <optional>

#include "core/motion/base_parameters.hpp"
#include "core/motion/planar.hpp"
#include "gui/model/held_keys.hpp"

namespace pilothouse::gui {

/// What a key means to driving. Two keys may mean the same.
enum class DriveKey : unsigned char {
  kForward,
  kBack,
  kTurnLeft,
  kTurnRight,
  kSideLeft,
  kSideRight,
  kSlow,
};

/// A physical key and its meaning; codes of one meaning differ in their low bits.
struct KeyMeaning {
  DriveKey meaning;
  unsigned variant;  ///< 0: the letter, 1: the arrow; the two Shift keys
};

/// Why driving by hand ended or does not begin.
enum class HandsOff {
  kNone,
  kFocusLost,    ///< another window has the keyboard
  kWindowHangs,  ///< the window does not answer: nobody sees what the robot does
  kStopped,      ///< the stop is pressed, or the gate is latched
  kTyping,       ///< keys go into a field
};

/// Turns held keys and the stick into commands: hold to drive, a zero on release, repeated while
/// the limiter still brings the robot to rest (a command that ages on the way would be a fault),
/// then silence so that others can drive. Nothing is sent before a person pressed something. A pure
/// state machine; times are steady seconds.
class Teleop {
 public:
  static constexpr double kPeriod = 0.04;      ///< between commands [s]: 25 Hz
  static constexpr double kSlowFactor = 0.35;  ///< of Shift
  static constexpr double kComesToRest = 2.0;  ///< zeros are repeated no longer than this [s]

  explicit Teleop(const BaseParameters& base) : base_(base) {}

  void press(KeyMeaning key, double now);
  /// Pressed for something else than driving: as long as it is held it means nothing here.
  void pressElsewhere(KeyMeaning key, double now);
  void release(KeyMeaning key, double now);
  /// Deflection of the on-screen stick, each -1..1 of the cap; absent: let go.
  void stick(std::optional<Twist2> deflection);
  /// @param cap path speed [m/s], 0..max_speed; turning is capped in proportion.
  void setCap(double cap);
  /// Ends driving now; what is held must be pressed anew.
  void interrupt(HandsOff reason);

  /// The command that is due now, if any. @param hindrance why none may be sent; kNone: go.
  /// @param moves the limiter still lets the robot move.
  std::optional<Twist2> step(double now, HandsOff hindrance, bool moves = false);

  bool driving() const { return driving_; }
  const Twist2& command() const { return command_; }  ///< newest [m/s, rad/s]
  HandsOff reason() const { return reason_; }         ///< of the end of the last drive
  bool held(DriveKey meaning, double now) const;
  /// Keys are down: step() wants to be called often.
  bool busy(double now) const {
    return driving_ || resting_ || keys_.busy(now) || stick_.has_value();
  }

 private:
  std::optional<Twist2> comeToRest(double now, bool moves);
  Twist2 wish(double now) const;
  bool wanted(double now) const;

  BaseParameters base_;
  HeldKeys keys_;
  std::optional<Twist2> stick_;
  double cap_ = 0.3;
  bool driving_ = false;
  bool resting_ = false;  ///< let go, the robot not yet at rest
  double next_ = 0.0, let_go_at_ = 0.0;
  Twist2 command_;
  HandsOff reason_ = HandsOff::kNone;
};

}  // namespace pilothouse::gui
