#include "gate/gate_messages.hpp"

#include <cstdio>

namespace pilothouse {
namespace {

static_assert(StopState::NONE == static_cast<int>(StopCause::kNone));
static_assert(StopState::NOT_ARMED == static_cast<int>(StopCause::kNotArmed));
static_assert(StopState::OPERATOR == static_cast<int>(StopCause::kOperator));
static_assert(StopState::STALE_PERCEPTION == static_cast<int>(StopCause::kStalePerception));
static_assert(StopState::STALE_ODOMETRY == static_cast<int>(StopCause::kStaleOdometry));
static_assert(StopState::OPERATOR_GONE == static_cast<int>(StopCause::kOperatorGone));
static_assert(StopState::BAD_COMMAND == static_cast<int>(StopCause::kBadCommand));
static_assert(StopState::STALE_LIMIT == static_cast<int>(StopCause::kStaleLimit));
static_assert(StopState::CLOCK == static_cast<int>(StopCause::kClock));
static_assert(StopState::STALE_COMMAND == static_cast<int>(StopCause::kStaleCommand));
static_assert(StopState::SECOND_PUBLISHER == static_cast<int>(StopCause::kSecondPublisher));
static_assert(StopState::STOPPED == static_cast<int>(GateStatus::kStopped));

std::string words(const StopFinding& finding, const GateInbox::Names& consoles,
                  const ShortName& publisher) {
  const std::string console =
      finding.console < 0 ? "" : consoles[static_cast<std::size_t>(finding.console)].data();
  return describe(finding, console, publisher.data());
}

void addValue(diagnostic_msgs::DiagnosticStatus& status, const char* key, double seconds) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3f s", seconds);
  diagnostic_msgs::KeyValue value;
  value.key = key;
  value.value = text;
  status.values.push_back(value);
}

}  // namespace

GateReport reportOf(const GateOutput& output, double ros, const GateInbox::Names& consoles,
                    const ShortName& publisher) {
  GateReport report{output, ros, {}, words(output.obstacle, consoles, publisher)};
  if (output.status == GateStatus::kStopped)
    report.text = words(output.stopped, consoles, publisher);
  else
    report.text = output.status == GateStatus::kIdle ? "armed, no command" : "commands pass";
  return report;
}

geometry_msgs::Twist twistOf(const Twist2& command) {
  geometry_msgs::Twist twist;
  twist.linear.x = command.vx;
  twist.linear.y = command.vy;
  twist.angular.z = command.w;
  return twist;
}

StopState stateOf(const GateReport& report) {
  const GateOutput& output = report.output;
  StopState state;
  state.header.stamp.fromSec(report.ros > 0.0 ? report.ros : 0.0);
  state.beat = output.beat;
  state.state = static_cast<std::uint8_t>(output.status);
  state.cause = static_cast<std::uint8_t>(output.stopped.cause);
  state.text = report.text;
  state.can_arm = !output.obstacle;
  state.obstacle_to_arming = report.obstacle;
  state.perception_age = static_cast<float>(output.perception_age);
  state.odometry_age = static_cast<float>(output.odometry_age);
  state.command_age = static_cast<float>(output.command_age);
  state.operator_age = static_cast<float>(output.operator_age);
  state.command = twistOf(output.command);
  return state;
}

diagnostic_msgs::DiagnosticStatus diagnosticOf(const GateReport& report) {
  using diagnostic_msgs::DiagnosticStatus;
  DiagnosticStatus status;
  status.name = "stop_gate: robot";
  status.hardware_id = "base";
  const GateOutput& output = report.output;
  const bool other = output.stopped.cause == StopCause::kSecondPublisher ||
                     output.obstacle.cause == StopCause::kSecondPublisher;
  if (output.status != GateStatus::kStopped)
    status.level = DiagnosticStatus::OK;
  else
    status.level = other ? DiagnosticStatus::ERROR : DiagnosticStatus::WARN;
  status.message = output.status == GateStatus::kStopped ? "stopped: " + report.text : report.text;
  if (other)
    status.message = "stopped: " + (report.obstacle.empty() ? report.text : report.obstacle);
  addValue(status, "age of perception", output.perception_age);
  addValue(status, "age of odometry", output.odometry_age);
  addValue(status, "age of the limiter's report", output.limit_age);
  addValue(status, "age of the command", output.command_age);
  addValue(status, "age of the operator", output.operator_age);
  return status;
}

}  // namespace pilothouse
