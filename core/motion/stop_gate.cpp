#include "core/motion/stop_gate.hpp"

#include <algorithm>
#include <cmath>

namespace pilothouse {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kFuture = 0.1;         // stamps may be ahead of our clock by so much [s]
constexpr double kClockJump = 0.5;      // ROS time may run apart from the steady clock, a step [s]
constexpr double kStandstill = 0.3;     // longest step: beyond it the gate itself was halted [s]
constexpr double kOverLimit = 1.05;     // rounding and ramps are no fault
constexpr double kNoSpeed = 1e-3;       // what a base cannot do must be no more than this
constexpr double kOtherHeld = 1.0;      // a second publisher is there so long after it spoke [s]
constexpr double kInCommand = 2.0;      // its commands still ramp down so long after the keys [s]
constexpr double kDrivenSpeed = 0.05;   // a base that is sent faster than this ... [m/s]
constexpr double kDrivenTurn = 0.2;     // ... or turns faster ... [rad/s]
constexpr double kDriven = 1.0;         // ... for so long moves, or is held, which shows too [s]
constexpr double kDip = 0.1;            // a command zero for no longer has not let it brake [s]
constexpr double kLately = 0.5;         // one that braked by its command stands by then [s]
constexpr double kStopForgotten = 5.0;  // a pressed stop of a console that is gone, then [s]

using Finding = StopFinding;

/// What one step works on.
struct Step {
  const GateParameters& p;
  GateState& s;
  const GateInputs& in;
  GateOutput out;
  Finding clock;
  double seconds = 0.0;  // since the last step

  double now() const { return in.now.steady; }
};

void forgetStamps(GateState& s) {
  s.perception.forget();
  s.odometry.forget();
  s.limit.forget();
  s.task.forget();
  s.teleop = {};
}

void takeTime(Step& g) {
  GateState& s = g.s;
  const double steady = g.in.now.steady - s.last.steady;
  const double ros = g.in.now.ros - s.last.ros;
  if (!std::isfinite(g.in.now.steady) || !std::isfinite(g.in.now.ros)) {
    g.clock = {StopCause::kClock, kInfinite, kClockJump, -1};
  } else if (s.started && !(steady >= 0.0 && steady <= kStandstill)) {
    g.clock = {StopCause::kClock, steady, kStandstill, -1};
  } else if (s.started && !(std::abs(ros - steady) <= kClockJump && ros >= -kFuture)) {
    g.clock = {StopCause::kClock, ros, kClockJump, -1};
  }
  if (g.clock) forgetStamps(s);
  if (s.started && !g.clock) g.seconds = steady;
  s.started = true;
  s.last = g.in.now;
}

bool isDriven(const Twist2& twist) {
  return twist.linear() > kDrivenSpeed || std::abs(twist.w) > kDrivenTurn;
}

void takeOdometry(Step& g) {
  GateState& s = g.s;
  const OdometryMessage& odometry = g.in.odometry;
  const Pose2 &pose = odometry.pose, &last = s.pose;
  const bool stays = pose.x == last.x && pose.y == last.y && pose.heading == last.heading;
  const bool rests = odometry.twist.zero();
  // A driver that froze while the robot stood says for ever that it stands.
  const bool must_move = s.driven_for > kDriven + g.p.steering_time;
  // No base that drives on stands from one reading to the next, not even a millimetre farther. One
  // whose command has just become zero might; but then it is not the next command that finds it so.
  // Its last reading that moved may have been missed: then the first that stands lies elsewhere.
  s.stood = rests && g.now() - s.driven_at <= kLately && (s.stood || isDriven(s.twist));
  s.halted = s.stood && (s.halted || s.driven);
  const bool frozen = stays && (!rests || s.halted || (must_move && s.twist.zero()));
  if (!frozen) s.odometry.take(odometry, g.in.now, kFuture);
  s.pose = pose;
  s.twist = odometry.twist;
}

void takeMessages(Step& g) {
  GateState& s = g.s;
  const GateInputs& in = g.in;
  takeOdometry(g);
  s.limit.take(in.limit, in.now, kFuture);
  s.perception.take({in.limit.perception_stamp, in.limit.arrival}, in.now, kFuture);
  // Whose command it is stands in the report; the two are published one after the other.
  if (in.limit.command_stamp == in.command.stamp) {
    s.source = in.limit.source;
    s.source_known = g.now();
  } else if (!(g.now() - s.source_known <= g.p.command_timeout)) {
    s.source = CommandSource::kUnknown;
  }
  if (s.source == CommandSource::kTask) s.task.take(in.command, in.now, kFuture);
  if (s.source == CommandSource::kTeleop && in.command.stamp != s.teleop.stamp)
    s.teleop = in.command;
  for (std::size_t i = 0; i < s.consoles.size(); ++i)
    s.consoles[i].take(in.consoles[i], s.beats, g.now());
}

/// Of a console's command: by the consoles from which a person drives, the worst counts.
double teleopAge(const Step& g) {
  double worst = -kInfinite;
  for (const ConsoleLink& console : g.s.consoles) {
    if (!console.inCommand(g.now(), kInCommand) || console.left()) continue;
    worst =
        std::max({worst, console.age(g.now()), console.commandAge(g.in.command.stamp, g.now())});
  }
  if (worst == -kInfinite) return kInfinite;
  return std::max(worst, g.now() - g.s.teleop.arrival);
}

double commandAge(const Step& g) {
  if (!(g.in.command.stamp > 0.0)) return kInfinite;
  if (g.s.source == CommandSource::kTask) return g.s.task.at(g.in.now);
  if (g.s.source == CommandSource::kTeleop) return teleopAge(g);
  return kInfinite;
}

/// Of the worst console in command; of the freshest where nobody drives.
double operatorAge(const Step& g) {
  double worst = -kInfinite, freshest = kInfinite;
  for (const ConsoleLink& console : g.s.consoles) {
    if (!console.used() || console.left()) continue;
    const double age = console.age(g.now());
    if (console.inCommand(g.now(), kInCommand)) worst = std::max(worst, age);
    freshest = std::min(freshest, age);
  }
  return worst >= 0.0 ? worst : freshest;
}

void takeAges(Step& g) {
  g.out.perception_age = g.s.perception.at(g.in.now);
  g.out.odometry_age = g.s.odometry.at(g.in.now);
  g.out.limit_age = g.s.limit.at(g.in.now);
  g.out.command_age = commandAge(g);
  g.out.operator_age = operatorAge(g);
}

Finding stopFinding(Step& g) {
  Finding found;
  if (g.in.stop_requests != g.s.stop_requests) found.cause = StopCause::kOperator;
  g.s.stop_requests = g.in.stop_requests;
  for (int i = 0; i < kMostConsoles; ++i)
    if (g.s.consoles[static_cast<std::size_t>(i)].takeStop())
      found = {StopCause::kOperator, 0.0, 0.0, i};
  return found;
}

Finding consoleFinding(Step& g) {
  for (int i = 0; i < kMostConsoles; ++i) {
    const auto slot = static_cast<std::size_t>(i);
    const ConsoleLink& console = g.s.consoles[slot];
    const double age = console.age(g.now());
    if (console.left() || !console.used()) {
      g.s.counted_on[slot] = false;
    } else if (age <= g.p.operator_timeout) {
      g.s.counted_on[slot] = true;
    } else if (!g.s.armed) {
      g.s.counted_on[slot] = false;
    } else if (g.s.counted_on[slot]) {
      return {StopCause::kOperatorGone, age, g.p.operator_timeout, i};
    }
  }
  return {};
}

/// Perception is known by the limiter's report: where that falls silent, both grow old together.
Finding perceptionFinding(const Step& g) {
  const double age = g.out.perception_age, limit = g.p.perception_timeout;
  if (age <= limit) return {};
  const bool was_fresh = age - g.out.limit_age <= limit && g.out.limit_age > 0.5 * limit;
  return {was_fresh ? StopCause::kStaleLimit : StopCause::kStalePerception, age, limit, -1};
}

/// The first of the faults that stop whoever is in command. Those that have to be looked at every
/// step come in by the arguments.
Finding faultFinding(const Step& g, const Finding& stop, const Finding& console) {
  const auto stale = [](StopCause cause, double age, double limit) {
    return age <= limit ? Finding{} : Finding{cause, age, limit, -1};
  };
  const double other = g.in.other_publisher ? 0.0 : g.now() - g.in.other_heard;
  const double bad_for = g.now() - g.in.command.arrival;
  Finding bad = commandFault(g.p, g.in.command);
  if (bad_for > g.p.command_timeout) bad = {};
  const Finding findings[] = {
      stop,
      g.clock,
      !(other > kOtherHeld) ? Finding{StopCause::kSecondPublisher, 0.0, 0.0, -1} : Finding{},
      bad,
      stale(StopCause::kStaleLimit, g.out.limit_age, g.p.limit_timeout),
      perceptionFinding(g),
      stale(StopCause::kStaleOdometry, g.out.odometry_age, g.p.odometry_timeout),
      console,
  };
  for (const Finding& finding : findings)
    if (finding) return finding;
  return {};
}

Finding obstacleToArming(const Step& g, const Finding& fault) {
  bool present = false;
  for (int i = 0; i < kMostConsoles; ++i) {
    const ConsoleLink& console = g.s.consoles[static_cast<std::size_t>(i)];
    if (!console.used() || console.left()) continue;
    if (console.stopPressed(g.now(), kStopForgotten)) return {StopCause::kStopPressed, 0.0, 0.0, i};
    present = present || console.age(g.now()) <= g.p.operator_timeout;
  }
  if (fault) return fault;
  if (g.p.require_operator && !present) return {StopCause::kNoOperator, 0.0, 0.0, -1};
  // Held by whom nobody knows counts as held by a person.
  const bool wanted = !(g.in.limit.wanted == 0.0) && g.in.limit.source != CommandSource::kTask;
  const bool passes = g.out.command_age <= g.p.command_timeout && !g.in.command.twist.zero() &&
                      g.s.source != CommandSource::kTask;
  if (wanted || passes) return {StopCause::kCommandHeld, g.in.limit.wanted, 0.0, -1};
  return {};
}

void latch(GateState& s, const Finding& finding) {
  s.armed = false;
  s.moving = false;
  s.stopped = finding;
}

void passCommand(Step& g) {
  if (!g.s.armed) return;
  if (g.out.command_age <= g.p.command_timeout) {
    g.out.status = GateStatus::kRunning;
    g.out.command = g.in.command.twist;
    g.s.moving = !g.out.command.zero();
  } else if (g.s.moving) {
    latch(g.s, {StopCause::kStaleCommand, g.out.command_age, g.p.command_timeout, -1});
  } else {
    g.out.status = GateStatus::kIdle;
  }
}

void noteDriven(Step& g) {
  GateState& s = g.s;
  s.driven = isDriven(g.out.command);
  if (s.driven) s.driven_at = g.now();
  // A dip does not undo it, however long it has been driven; commands that are zero mostly do.
  const double enough = kDriven + g.p.steering_time + 2.0 * kDip;
  const double longer = s.driven_for + (s.driven ? g.seconds : -g.seconds);
  s.driven_for = g.now() - s.driven_at > kDip ? 0.0 : std::clamp(longer, 0.0, enough);
}

}  // namespace

StopFinding commandFault(const GateParameters& p, const CommandMessage& command) {
  if (!command.twist.finite() || !std::isfinite(command.off_plane))
    return {StopCause::kBadCommand, std::numeric_limits<double>::quiet_NaN(), 0.0, -1};
  const double pairs[][2] = {
      {command.twist.linear(), p.max_speed * kOverLimit},
      {std::abs(command.twist.w), p.max_turn_rate * kOverLimit},
      {p.can_go_sideways ? 0.0 : std::abs(command.twist.vy), kNoSpeed},
      {std::abs(command.off_plane), kNoSpeed},
  };
  for (const auto& [value, limit] : pairs)
    if (value > limit) return {StopCause::kBadCommand, value, limit, -1};
  return {};
}

GateOutput step(const GateParameters& parameters, GateState& state, const GateInputs& inputs) {
  Step g{parameters, state, inputs, {}, {}};
  takeTime(g);
  takeMessages(g);
  takeAges(g);
  const Finding stop = stopFinding(g);
  const Finding fault = faultFinding(g, stop, consoleFinding(g));
  if (state.armed && fault) latch(state, fault);
  if (stop) latch(state, stop);  // the person's own stop is the cause to tell, whatever came before
  g.out.obstacle = obstacleToArming(g, fault);
  if (inputs.arm_requests != state.arm_requests && !g.out.obstacle) state.armed = true;
  state.arm_requests = inputs.arm_requests;
  passCommand(g);
  noteDriven(g);
  g.out.stopped = state.armed ? Finding{} : state.stopped;
  g.out.beat = state.beats.next(inputs.now.steady);
  return g.out;
}

}  // namespace pilothouse
