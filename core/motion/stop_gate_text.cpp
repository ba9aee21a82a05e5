#include <cmath>
#include <cstdio>

#include "core/cloud/quoted.hpp"
#include "core/motion/stop_gate.hpp"

namespace pilothouse {
namespace {

std::string old(const char* thing, const StopFinding& finding) {
  if (!std::isfinite(finding.value)) return std::string(thing) + " never came";
  char text[128];
  std::snprintf(text, sizeof text, "%s is %.2f s old, limit %.2f s", thing, finding.value,
                finding.limit);
  return text;
}

std::string badCommand(const StopFinding& finding) {
  if (std::isnan(finding.value)) return "a command was not a finite number";
  char text[128];
  std::snprintf(text, sizeof text, "a command of %.3g is over the base's limit of %.3g",
                finding.value, finding.limit);
  return text;
}

std::string clockText(const StopFinding& finding) {
  char text[128];
  const bool standstill = finding.limit < 0.5;
  std::snprintf(text, sizeof text,
                standstill ? "the stop gate itself stood still for %.2f s"
                           : "time jumped: a step took %.2f s by ROS time",
                finding.value);
  return text;
}

}  // namespace

std::string describe(const StopFinding& finding, const std::string& console,
                     const std::string& publisher) {
  switch (finding.cause) {
    case StopCause::kNone:
      return {};
    case StopCause::kNotArmed:
      return "not armed since the start";
    case StopCause::kOperator:
      return finding.console < 0 ? "stopped by request" : "stopped from console " + quoted(console);
    case StopCause::kStalePerception:
      return old("perception", finding);
    case StopCause::kStaleOdometry:
      return old("odometry", finding);
    case StopCause::kStaleCommand:
      return std::isfinite(finding.value) ? old("the command that was driven", finding)
                                          : "whose command it is, nobody says any more";
    case StopCause::kOperatorGone:
      return old(("the sign of life of console " + quoted(console)).c_str(), finding);
    case StopCause::kSecondPublisher:
      return "somebody else publishes on cmd_vel: " + quoted(publisher);
    case StopCause::kBadCommand:
      return badCommand(finding);
    case StopCause::kStaleLimit:
      return old("what the speed limiter reports", finding);
    case StopCause::kClock:
      return clockText(finding);
    case StopCause::kCommandHeld:
      return "a command is held: let go of the keys first";
    case StopCause::kStopPressed:
      return "the stop is pressed on console " + quoted(console);
    case StopCause::kNoOperator:
      return "no console is there, and this robot needs one";
  }
  return "unknown cause";
}

std::vector<std::string> validate(const GateParameters& parameters) {
  std::vector<std::string> faults;
  const auto check = [&faults](const char* key, double value, double low, double high) {
    if (value >= low && value <= high) return;
    char text[128];
    std::snprintf(text, sizeof text, "%s is %g, expected %g to %g", key, value, low, high);
    faults.push_back(text);
  };
  forEachGateParameter(parameters, check);
  check("max_speed", parameters.max_speed, 0.01, 10.0);
  check("max_turn_rate", parameters.max_turn_rate, 0.01, 10.0);
  return faults;
}

}  // namespace pilothouse
