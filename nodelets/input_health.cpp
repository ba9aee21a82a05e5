#include "nodelets/input_health.hpp"

#include <algorithm>
#include <vector>

namespace pilothouse {
namespace {

using diagnostic_msgs::DiagnosticStatus;

double seconds(InputHealth::Clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

}  // namespace

void InputHealth::listening(bool on) {
  std::lock_guard<std::mutex> lock(mutex_);
  listening_ = on;
  listening_since_ = Clock::now();
  arrived_since_listening_ = 0;
}

void InputHealth::arrived() {
  std::lock_guard<std::mutex> lock(mutex_);
  last_arrival_ = Clock::now();
  arrivals_[arrived_since_listening_++ % kWindow] = last_arrival_;
  ++arrived_;
}

void InputHealth::stamped(double age) {
  std::lock_guard<std::mutex> lock(mutex_);
  age_ = age;
}

void InputHealth::accepted(Clock::duration processing) {
  std::lock_guard<std::mutex> lock(mutex_);
  last_accept_ = Clock::now();
  processing_ms_[accepted_++ % kWindow] = static_cast<float>(seconds(processing) * 1e3);
}

void InputHealth::rejected(const std::string& kind, const std::string& reason) {
  std::lock_guard<std::mutex> lock(mutex_);
  ++rejected_;
  ++rejected_by_kind_[kind];
  last_reason_ = reason;
}

void InputHealth::timeJumped() {
  std::lock_guard<std::mutex> lock(mutex_);
  ++time_jumps_;
}

double InputHealth::rate(Clock::time_point now) const {
  // Over the last five seconds of the window, up to now, so that it falls when the input stops.
  std::size_t recent = 0;
  Clock::time_point oldest = now;
  const std::uint64_t held = std::min<std::uint64_t>(arrived_since_listening_, kWindow);
  for (std::uint64_t i = 0; i < held; ++i) {
    if (seconds(now - arrivals_[i]) > 5.0) continue;
    oldest = std::min(oldest, arrivals_[i]);
    ++recent;
  }
  const double span = seconds(now - oldest);
  return recent > 1 && span > 0.0 ? static_cast<double>(recent) / span : 0.0;
}

void InputHealth::judge(diagnostic_updater::DiagnosticStatusWrapper& status,
                        Clock::time_point now) {
  const double silence = seconds(now - std::max(last_arrival_, listening_since_));
  const double fruitless = seconds(now - std::max(last_accept_, listening_since_));
  if (!listening_) {
    status.summary(DiagnosticStatus::OK, "idle: nobody listens");
  } else if (silence > timeout_) {
    status.summaryf(DiagnosticStatus::ERROR, "no input for %.1f s on %s", silence, input_.c_str());
  } else if (fruitless > timeout_ && rejected_ > 0) {
    status.summary(DiagnosticStatus::ERROR, "every input is rejected: " + last_reason_);
  } else if (rejected_ > rejected_reported_) {
    status.summary(DiagnosticStatus::WARN, "input rejected: " + last_reason_);
  } else {
    status.summary(DiagnosticStatus::OK, "running");
  }
  rejected_reported_ = rejected_;
}

void InputHealth::addProcessing(diagnostic_updater::DiagnosticStatusWrapper& status) const {
  const auto held = static_cast<std::ptrdiff_t>(std::min<std::uint64_t>(accepted_, kWindow));
  if (held == 0) {
    status.add("processing time median [ms]", "none yet");
    status.add("processing time p95 [ms]", "none yet");
    return;
  }
  std::vector<float> sorted(processing_ms_.begin(), processing_ms_.begin() + held);
  std::sort(sorted.begin(), sorted.end());
  status.add("processing time median [ms]", sorted[sorted.size() / 2]);
  status.add("processing time p95 [ms]", sorted[(sorted.size() - 1) * 95 / 100]);
}

void InputHealth::report(diagnostic_updater::DiagnosticStatusWrapper& status) {
  std::lock_guard<std::mutex> lock(mutex_);
  const auto now = Clock::now();
  judge(status, now);
  status.add("input", input_);
  status.add("rate [Hz]", rate(now));
  status.add("age of input [s]", age_);
  status.add("arrived", arrived_);
  status.add("accepted", accepted_);
  status.add("rejected", rejected_);
  for (const auto& entry : rejected_by_kind_) status.add("rejected: " + entry.first, entry.second);
  status.add("last rejection", last_reason_);
  status.add("time jumps", time_jumps_);
  addProcessing(status);
}

}  // namespace pilothouse
