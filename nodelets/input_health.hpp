#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>

namespace pilothouse {

/// How one sensor input fares: rate, age, what was accepted and refused and why, and how long the
/// work on it took. Any thread may call any function.
class InputHealth {
 public:
  using Clock = std::chrono::steady_clock;

  /// @param timeout without an input for this long [s] the state is an error.
  InputHealth(std::string input, double timeout) : input_(std::move(input)), timeout_(timeout) {}

  /// The input was subscribed to, or not any more (then the state is idle).
  void listening(bool on);
  void arrived();
  /// @param age ROS time from the input's stamp to its arrival [s].
  void stamped(double age);
  void accepted(Clock::duration processing);
  /// @param kind one of a few words to count by; @param reason in full, for a human.
  void rejected(const std::string& kind, const std::string& reason);
  void timeJumped();

  void report(diagnostic_updater::DiagnosticStatusWrapper& status);

 private:
  static constexpr std::size_t kWindow = 300;  ///< frames that figures are taken over
  double rate(Clock::time_point now) const;
  void judge(diagnostic_updater::DiagnosticStatusWrapper& status, Clock::time_point now);
  void addProcessing(diagnostic_updater::DiagnosticStatusWrapper& status) const;

  std::mutex mutex_;
  std::string input_;
  double timeout_;
  bool listening_ = false;
  Clock::time_point listening_since_, last_arrival_, last_accept_;
  std::array<Clock::time_point, kWindow> arrivals_;
  std::array<float, kWindow> processing_ms_;
  std::uint64_t arrived_ = 0, accepted_ = 0, rejected_ = 0, rejected_reported_ = 0;
  std::uint64_t arrived_since_listening_ = 0, time_jumps_ = 0;
  std::map<std::string, std::uint64_t> rejected_by_kind_;
  std::string last_reason_ = "none";
  double age_ = 0.0;  ///< of the newest input when it arrived, ROS time [s]
};

}  // namespace pilothouse
