#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "core/motion/console_link.hpp"
#include "core/motion/input_age.hpp"
#include "core/motion/planar.hpp"

namespace pilothouse {

/// Limits of the stop gate.
struct GateParameters {
  double perception_timeout = 0.3;  ///< oldest sensor that safety needs [s], 0.05..2
  double odometry_timeout = 0.3;    ///< [s], 0.05..2
  double limit_timeout = 0.3;       ///< report of the speed limiter [s], 0.05..2
  double command_timeout = 0.3;     ///< [s], 0.05..2
  double operator_timeout = 0.3;    ///< sign of life of a console [s], 0.05..0.5
  bool require_operator = false;    ///< armed only while a console is there
  // ---- of the base
  double max_speed = 0.6;       ///< [m/s], 0.01..10
  double max_turn_rate = 1.5;   ///< [rad/s], 0.01..10
  double steering_time = 0.0;   ///< until its wheels stand right for a new command [s]
  bool can_go_sideways = true;  ///< false: any sideways speed is over the limit
};

/// Calls visit(key, value, low, high) for every number that a robot may set.
template <class Parameters, class Visit>
void forEachGateParameter(Parameters& p, Visit visit) {
  visit("perception_timeout", p.perception_timeout, 0.05, 2.0);
  visit("odometry_timeout", p.odometry_timeout, 0.05, 2.0);
  visit("limit_timeout", p.limit_timeout, 0.05, 2.0);
  visit("command_timeout", p.command_timeout, 0.05, 2.0);
  visit("operator_timeout", p.operator_timeout, 0.05, 0.5);
}

/// Every fault, one line each naming key, value and range; empty when sound.
std::vector<std::string> validate(const GateParameters& parameters);

/// What stops the robot, or keeps it from being armed.
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
  // only obstacles to arming
  kCommandHeld,  ///< the robot would start of itself
  kStopPressed,
  kNoOperator,
};

/// A cause with its figures.
struct StopFinding {
  StopCause cause = StopCause::kNone;
  double value = 0.0;  ///< age or jump [s], or the speed that was too high
  double limit = 0.0;  ///< that it should have kept
  int console = -1;    ///< slot of the console that it is about; -1: none

  explicit operator bool() const { return cause != StopCause::kNone; }
};

/// "odometry is 0.41 s old, limit 0.30 s".
/// @param console name of the console that it is about
/// @param publisher who else publishes commands
std::string describe(const StopFinding& finding, const std::string& console,
                     const std::string& publisher);

enum class GateStatus : std::uint8_t { kRunning, kIdle, kStopped };
enum class CommandSource : std::uint8_t { kNobody, kTeleop, kTask, kUnknown };

constexpr int kMostConsoles = 4;

/// A velocity as it came in.
struct CommandMessage : Arrival {
  Twist2 twist;
  double off_plane = 0.0;  ///< largest of its other components; NaN if one is
};

/// Where the robot is by its wheels; finite.
struct OdometryMessage : Arrival {
  Pose2 pose;
  Twist2 twist;
};

/// The newest report of the speed limiter.
struct LimitMessage : Arrival {
  double perception_stamp = 0.0, command_stamp = 0.0;  ///< [s]
  double wanted = 0.0;  ///< path speed of the wish before it was limited [m/s]
  CommandSource source = CommandSource::kNobody;
};

/// All that the gate knows at one instant: the newest message of each input.
struct GateInputs {
  GateTime now;
  OdometryMessage odometry;
  LimitMessage limit;
  CommandMessage command;
  std::array<ConsoleMessage, kMostConsoles> consoles;
  bool other_publisher = false;  ///< somebody else is connected to the base's topic
  double other_heard = -std::numeric_limits<double>::infinity();  ///< or spoke then, steady [s]
  std::uint32_t stop_requests = 0, arm_requests = 0;              ///< so far
};

/// What the gate remembers from step to step.
struct GateState {
  explicit GateState(std::uint32_t first_beat = 1) : beats(first_beat) {}

  bool started = false;
  GateTime last;
  bool armed = false;
  StopFinding stopped{StopCause::kNotArmed, 0.0, 0.0, -1};
  bool moving = false;  ///< the last command that passed was not zero
  InputAge perception, odometry, limit, task;
  Pose2 pose;           ///< by the newest odometry
  Twist2 twist;         ///< by it
  bool driven = false;  ///< the last command that passed makes a base move
  double driven_at = -std::numeric_limits<double>::infinity();  ///< when one last did, steady [s]
  double driven_for = 0.0;  ///< so much longer than not, dips of the command left out [s]
  bool stood = false;       ///< odometry stood from one reading to the next, driven lately
  bool halted = false;      ///< and a command drove then, or since
  Arrival teleop;           ///< newest stamp of the console's clock, and when it first came
  CommandSource source = CommandSource::kUnknown;
  double source_known = -std::numeric_limits<double>::infinity();  ///< steady [s]
  BeatTimes beats;
  std::array<ConsoleLink, kMostConsoles> consoles;
  std::array<bool, kMostConsoles> counted_on{};  ///< there since arming: its silence is a fault
  std::uint32_t stop_requests = 0, arm_requests = 0;
};

/// What is published after a step.
struct GateOutput {
  std::uint32_t beat = 0;
  GateStatus status = GateStatus::kStopped;
  StopFinding stopped;   ///< why, when stopped
  StopFinding obstacle;  ///< to arming; none: it would be accepted
  double perception_age = 0.0, odometry_age = 0.0, limit_age = 0.0;  ///< [s], infinite: unknown
  double command_age = 0.0, operator_age = 0.0;
  Twist2 command;  ///< finite and within the base's limits; zero unless running
};

/// One step of the stop gate, the last stage before the base: unknown means stop, a stop holds
/// until a person arms again. Starts stopped. A pure function of its arguments; allocates nothing.
///
/// While armed, each of these stops and latches: a perception, odometry or limiter's report older
/// than its limit (of the ORIGINAL: see InputAge; odometry that stays the same to the last bit
/// while it or a second of commands says that the robot moves, or since it stood at once in full
/// drive, is no newer for its stamps; a command that dips to zero for moments drives all the same);
/// the command's source silent while the robot moved; a console silent that was there since arming
/// and did not say that it leaves; an operator's stop; a second publisher; a command that is not
/// finite or over the base's limits; a jump of a clock, or a gate that itself stood still. Without
/// a command, the last one zero, it is idle, which is no fault. A teleop command counts as no
/// younger than the newest sign of life of the console in command, so that none older than its
/// limit is acted on, whatever a link delays. Arming is refused while any of these holds, and while
/// a command of a person is held: it must have been zero before. A task may go on after arming.
GateOutput step(const GateParameters& parameters, GateState& state, const GateInputs& inputs);

/// What is wrong with a command in itself: nothing, or kBadCommand.
StopFinding commandFault(const GateParameters& parameters, const CommandMessage& command);

}  // namespace pilothouse
