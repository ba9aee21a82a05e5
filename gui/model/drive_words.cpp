#include "gui/model/drive_words.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace pilothouse::gui {

namespace {

constexpr double kSilent = 0.5;        // s; the gate speaks 50 times a second, the limiter 30
constexpr double kContactShown = 3.0;  // s
constexpr double kStands = 0.005;      // m/s
constexpr double kPassing = 0.02;      // m
constexpr double kArmsAtOnce = 1.0;    // s

std::string number(double value, const char* unit, int digits = 2) {
  char text[48];
  std::snprintf(text, sizeof text, "%.*f %s", digits, value, unit);
  return text;
}

// Seen from the robot; what has no place is ahead.
const char* side(const LimitReading& limit) {
  if (!std::isfinite(limit.x) || !std::isfinite(limit.y)) return "ahead";
  if (std::abs(limit.y) <= std::abs(limit.x)) return limit.x < 0.0 ? "behind" : "ahead";
  return limit.y > 0.0 ? "to the left" : "to the right";
}

std::string where(const LimitReading& limit) {
  if (!std::isfinite(limit.distance)) return {};
  return " " + number(std::max(0.0, limit.distance), "m") + " " + side(limit);
}

// What the robot passes already has no free way before it.
std::string besideTheWay(const LimitReading& limit) {
  if (limit.distance < kPassing) {
    const bool left = limit.y > 0.0;  // false for NaN
    return std::isfinite(limit.y) ? std::string(" close by on the ") + (left ? "left" : "right")
                                  : " close by";
  }
  return " beside the way" + where(limit);
}

std::string seer(const std::string& sensor) {
  if (sensor.empty()) return "a sensor";
  return sensor == "camera" ? "camera" : sensor + " ranger";
}

std::string sees(const LimitReading& limit) {
  return limit.sensor == "memory" ? "something remembered" : seer(limit.sensor) + " sees something";
}

std::string slowed(const LimitReading& limit) {
  return limit.limit <= kStands ? "Held at 0 m/s" : "Slowed to " + number(limit.limit, "m/s");
}

std::string staleInput(const LimitReading& limit) {
  const std::string input = limit.sensor.empty() ? "an input" : limit.sensor;
  return std::isnan(limit.input_age) ? "nothing from " + input + " yet"
                                     : input + " silent for " + number(limit.input_age, "s", 1);
}

std::string defaultText(const StopReading& stop) {
  const auto silent = [](const char* what, double age) {
    return std::isfinite(age) ? what + (" silent for " + number(age, "s", 1))
                              : "nothing from " + std::string(what);
  };
  switch (stop.cause) {
    case StopCause::kNone:
      return "no cause told";
    case StopCause::kNotArmed:
      return "not armed yet";
    case StopCause::kOperator:
      return "operator's stop";
    case StopCause::kStalePerception:
      return silent("camera", stop.perception_age);
    case StopCause::kStaleOdometry:
      return silent("odometry", stop.odometry_age);
    case StopCause::kStaleCommand:
      return "commands ended while the robot moved";
    case StopCause::kOperatorGone:
      return "the operator's console fell silent";
    case StopCause::kSecondPublisher:
      return "somebody else publishes on cmd_vel";
    case StopCause::kBadCommand:
      return "a command that is not finite or over the limits";
    case StopCause::kStaleLimit:
      return "speed limiter silent";
    case StopCause::kClock:
      return "the clock jumped";
  }
  return {};
}

std::string armAdvice(const StopReading& stop, bool own_stop) {
  if (stop.can_arm || own_stop || stop.obstacle_to_arming.empty()) {
    return "Hold Arm (F9) for a second to go on";
  }
  return "Before arming: " + stop.obstacle_to_arming;
}

std::string limitAdvice(const LimitReading& limit) {
  switch (limit.cause) {
    case LimitCause::kObstacle:
    case LimitCause::kBraking:
      return limit.limit <= kStands ? "Drive round it, back off, or wait until the way is free"
                                    : "Goes on by itself when the way is free";
    case LimitCause::kPotential:
      return "Faster again once it is passed";
    case LimitCause::kThreshold:
      return "Faster again behind it";
    case LimitCause::kUnseen:
      return "Turn so that the camera looks where you want to go";
    case LimitCause::kStale:
      return "Goes on by itself when it speaks again";
    case LimitCause::kBadCommand:
      return "Whoever sends the commands must be put right";
    case LimitCause::kFree:
      break;
  }
  return {};
}

DriveWords running(const DriveSituation& s) {
  const LimitReading& limit = s.limit;
  const std::string keys = "Hold W A S D or the arrow keys to drive, Space stops";
  if (!s.limit_state.ever || s.limit_state.age_s > kSilent) {
    return {Severity::kError, "Speed limiter silent", "Is the robot's side running?"};
  }
  if (std::abs(limit.wanted) <= kStands && limit.cause != LimitCause::kStale) {
    return {Severity::kGood, "Ready: nobody drives", keys};
  }
  if (limit.cause == LimitCause::kFree) {
    const std::string who = limit.source == "teleop" ? " by hand"
                            : limit.source.empty()   ? ""
                                                     : " by " + limit.source;
    return {Severity::kGood, "Driving" + who + " at " + number(limit.limited, "m/s"),
            "The way is free"};
  }
  const bool fault = limit.cause == LimitCause::kStale || limit.cause == LimitCause::kBadCommand;
  return {fault ? Severity::kError : Severity::kWarning, limitWords(limit), limitAdvice(limit)};
}

std::string handsOff(HandsOff reason) {
  switch (reason) {
    case HandsOff::kFocusLost:
      return "Driving ended: another window has the keyboard";
    case HandsOff::kWindowHangs:
      return "Driving ended: this window did not answer. Let go and press anew";
    case HandsOff::kTyping:
      return "Keys go into a field: click the map to drive";
    case HandsOff::kNone:
    case HandsOff::kStopped:
      break;
  }
  return {};
}

DriveWords gateWords(const DriveSituation& s) {
  if (!s.stop_state.ever) {
    if (s.helm.stop) {
      return {Severity::kError, "Stop pressed, but no stop gate has answered yet",
              "The stop is sent to every gate that comes"};
    }
    return {Severity::kNote, "No stop gate: nothing can be driven from here",
            "Watching only. Start the robot's side to drive"};
  }
  if (s.stop_state.age_s > kSilent) {
    const std::string age = number(s.stop_state.age_s, "s", s.stop_state.age_s < 10 ? 1 : 0);
    return {Severity::kError,
            s.helm.stop ? "Stop pressed, but the stop gate is silent for " + age
                        : "Stop gate silent for " + age,
            "The base halts by itself without it"};
  }
  if (s.helm.stop && s.stop.phase != GatePhase::kStopped) {
    return {Severity::kError, "Stop pressed, not confirmed by the gate yet", "Use the robot's own"};
  }
  if (s.stop.phase == GatePhase::kStopped) {
    const bool start = s.stop.cause == StopCause::kNotArmed && !s.helm.stop;
    return {start ? Severity::kWarning : Severity::kError, stopWords(s.stop),
            armAdvice(s.stop, s.helm.stop)};
  }
  return running(s);
}

}  // namespace

std::string limitWords(const LimitReading& limit) {
  switch (limit.cause) {
    case LimitCause::kFree:
      return "The way is free";
    case LimitCause::kObstacle:
      return slowed(limit) + ": " + sees(limit) + where(limit);
    case LimitCause::kPotential:
      return slowed(limit) + ": " + sees(limit) + besideTheWay(limit);
    case LimitCause::kBraking:
      return "Braking: " + sees(limit) + where(limit);
    case LimitCause::kThreshold:
      return slowed(limit) + ": a threshold" + where(limit);
    case LimitCause::kUnseen:
      return slowed(limit) + ": nothing has looked there";
    case LimitCause::kStale:
      return "Stopped: " + staleInput(limit);
    case LimitCause::kBadCommand:
      return "Stopped: the wanted command is not finite";
  }
  return {};
}

std::string routeWords(const RouteReading& route) {
  const std::string to = "route: to point " + std::to_string(route.target + 1) + " of " +
                         std::to_string(route.points) + ", " + number(route.distance_left, "m", 1) +
                         " left";
  switch (route.phase) {
    case RoutePhase::kIdle:
      return {};
    case RoutePhase::kDriving:
      return to;
    case RoutePhase::kWaiting:
      return to + ", waiting" + (route.text.empty() ? "" : ": " + route.text);
    case RoutePhase::kReached:
      return "route: reached";
    case RoutePhase::kRefused:
      return "route refused: " + route.text;
  }
  return {};
}

std::string stopWords(const StopReading& stop) {
  if (stop.cause == StopCause::kNotArmed) return "Not armed: the robot stands";
  return "Stopped: " + (stop.text.empty() ? defaultText(stop) : stop.text);
}

DriveWords driveWords(const DriveSituation& s) {
  // Who drives and who stops needs no master once they have found each other.
  const bool gate_speaks = s.stop_state.ever && s.stop_state.age_s <= kSilent;
  if (!s.connected && !gate_speaks && !s.helm.stop) {
    return {Severity::kNote, "No robot: no ROS master answers",
            "Connects by itself when one starts"};
  }
  DriveWords words = gateWords(s);
  if (s.arming_for < kArmsAtOnce) {
    words.advice = "Arming";
  } else if (s.arming_for >= kArmsAtOnce) {
    words.severity = Severity::kError;
    words.advice = "Arming: no answer for " + number(s.arming_for, "s", 0) + ". It may be too late";
  } else if (!s.arming_refused.empty()) {
    words.severity = Severity::kError;
    words.advice = "Not armed: " + s.arming_refused;
  } else if (!s.helm.driving && words.severity != Severity::kError) {
    const std::string ended = handsOff(s.helm.reason);
    if (!ended.empty()) words.advice = ended;
  }
  if (!s.contacts.touching.empty() && s.now - s.contacts.at < kContactShown) {
    words.severity = Severity::kError;
    words.headline = "Contact: touches " + s.contacts.touching.front();
  }
  if (!s.connected) {
    words.severity = std::max(words.severity, Severity::kWarning);
    words.advice = "The ROS master is lost; what runs goes on" +
                   (words.advice.empty() ? "" : ". " + words.advice);
  }
  return words;
}

}  // namespace pilothouse::gui
