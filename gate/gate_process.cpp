#include "gate/gate_process.hpp"

#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/console.h>
#include <ros/this_node.h>

#include <random>

#include "doors/steady_clock.hpp"
#include "gate/real_time.hpp"

namespace pilothouse {
namespace {

constexpr double kPeriod = 0.02;                          // [s]
constexpr double kAnswerPeriod = 0.005;                   // while somebody else drives the base [s]
constexpr auto kAnswer = std::chrono::milliseconds(500);  // a service waits for the beat
constexpr auto kLook = std::chrono::milliseconds(200);    // for publishers that are silent
constexpr int kLooksPerDiagnostic = 5;

}  // namespace

GateProcess::GateProcess(const GateParameters& parameters, ros::NodeHandle& handle)
    : parameters_(parameters),
      inbox_(parameters, handle),
      watch_(handle, "cmd_vel"),
      // A console may still tell a beat of an earlier life of the gate: it must not look like a new
      // one.
      state_(std::random_device{}() >> 1) {
  commands_ = handle.advertise<geometry_msgs::Twist>("cmd_vel", 1);
  states_ = handle.advertise<StopState>("stop_state", 10);
  diagnostics_ = handle.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 10);
  ros::NodeHandle services(handle);
  services.setCallbackQueue(&services_queue_);
  arm_ = services.advertiseService("stop_gate/arm", &GateProcess::arm, this);
  stop_ = services.advertiseService("stop_gate/stop", &GateProcess::stop, this);
  inbox_.start();
  watch_.start();
  services_spinner_.start();
  beat_ = std::thread([this] { beat(); });
  reporter_ = std::thread([this] { report(); });
}

GateProcess::~GateProcess() {
  ending_ = true;
  beat_.join();
  commands_.publish(geometry_msgs::Twist());
  changed_.notify_all();
  reporter_.join();
}

void GateProcess::beat() {
  const std::string refused = becomeRealTime();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    not_real_time_ = refused;
  }
  GateInputs inputs;
  SteadyPace pace;
  double last = steadyNow();
  while (!ending_) {
    beatOnce(inputs);
    const bool answering = inputs.now.steady - seen_.heard < 1.0;
    pace.wait(answering ? kAnswerPeriod : kPeriod);
    const double now = steadyNow();
    if (now - last > longest_beat_) longest_beat_ = now - last;
    last = now;
  }
}

void GateProcess::beatOnce(GateInputs& inputs) {
  inbox_.read(inputs, names_);
  watch_.read(seen_);
  inputs.other_publisher = seen_.connected;
  inputs.other_heard = seen_.heard;
  inputs.now = {steadyNow(), ros::Time::now().toSec()};
  const GateOutput output = step(parameters_, state_, inputs);
  commands_.publish(twistOf(output.command));
  GateReport report = reportOf(output, inputs.now.ros, names_, seen_.name);
  states_.publish(stateOf(report));
  share(std::move(report), inputs);
}

void GateProcess::share(GateReport&& report, const GateInputs& inputs) {
  const std::unique_lock<std::mutex> lock(mutex_, std::try_to_lock);
  if (!lock) return;
  newest_ = std::move(report);
  stops_handled_ = inputs.stop_requests;
  arms_handled_ = inputs.arm_requests;
  changed_.notify_all();
}

void GateProcess::waitUntilHandled(std::unique_lock<std::mutex>& lock, const std::uint32_t& handled,
                                   std::uint32_t request) {
  changed_.wait_for(lock, kAnswer, [&] { return ending_ || handled >= request; });
}

bool GateProcess::arm(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  std::unique_lock<std::mutex> lock(mutex_);
  const std::uint32_t request = inbox_.requestArming();
  waitUntilHandled(lock, arms_handled_, request);
  response.success = arms_handled_ >= request && newest_.output.status != GateStatus::kStopped;
  response.message = response.success ? "armed" : "not armed: " + newest_.obstacle;
  return true;
}

bool GateProcess::stop(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  std::unique_lock<std::mutex> lock(mutex_);
  const std::uint32_t request = inbox_.requestStop();
  waitUntilHandled(lock, stops_handled_, request);
  response.success = stops_handled_ >= request && newest_.output.status == GateStatus::kStopped;
  response.message = newest_.text;
  return true;
}

void GateProcess::report() {
  StopCause told = StopCause::kNone;
  bool warned = false;
  for (int round = 0; !ending_; ++round) {
    watch_.look();
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait_for(lock, kLook, [&] { return ending_.load(); });
    const GateReport now = newest_;
    const std::string refused = not_real_time_;
    lock.unlock();
    if (!warned && !refused.empty())
      ROS_WARN("Stop gate runs without %s: a busy computer may delay it", refused.c_str());
    warned = warned || !refused.empty();
    reportOnce(now, told);
    if (round % kLooksPerDiagnostic != 0) continue;
    diagnostic_msgs::DiagnosticArray array;
    array.header.stamp = ros::Time::now();
    array.status.push_back(diagnostic(now));
    diagnostics_.publish(array);
  }
}

void GateProcess::reportOnce(const GateReport& now, StopCause& told) {
  const StopCause cause = now.output.stopped.cause;
  if (cause == told) return;
  if (cause == StopCause::kNone)
    ROS_INFO("Armed");
  else if (cause == StopCause::kSecondPublisher)
    ROS_ERROR("Stopped: %s", now.text.c_str());
  else
    ROS_WARN("Stopped: %s", now.text.c_str());
  told = cause;
}

diagnostic_msgs::DiagnosticStatus GateProcess::diagnostic(const GateReport& report) {
  using diagnostic_msgs::DiagnosticStatus;
  DiagnosticStatus status = diagnosticOf(report);
  const auto add = [&status](const char* key, const std::string& text) {
    diagnostic_msgs::KeyValue value;
    value.key = key;
    value.value = text;
    status.values.push_back(value);
  };
  add("longest time between beats",
      std::to_string(static_cast<int>(1000.0 * longest_beat_.exchange(0.0))) + " ms");
  const auto [refused, reason] = inbox_.refusals();
  add("messages refused", std::to_string(refused));
  if (refused > 0) add("last refusal", reason);
  for (const std::string& other : watch_.listed()) {
    add("also advertises cmd_vel", other);
    if (status.level == DiagnosticStatus::OK) status.level = DiagnosticStatus::WARN;
  }
  return status;
}

}  // namespace pilothouse
