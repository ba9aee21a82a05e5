#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <utility>

namespace pilothouse {

/// Keeps simulated time in step with the steady clock. Ticks that come late are made up for, unless
/// they are so late that the past is better given up.
class SimulatorPace {
 public:
  using Clock = std::chrono::steady_clock;

  /// @param rate simulated seconds a second; 0: as fast as possible. @param tick [s].
  SimulatorPace(double rate, double tick) : rate_(rate), tick_(tick) {}

  void start(Clock::time_point now);
  /// A tick was done. Far too late, the next one is due at once and what lies between given up.
  void ticked(Clock::time_point now);
  /// When the next tick is due; in the past where ticks are late or nothing is waited for.
  Clock::time_point next() const { return next_; }

  double rate() const { return rate_; }
  /// Simulated seconds a second over the last seconds; 0 before there are any.
  double factor() const;
  std::uint64_t givenUp() const { return given_up_; }  ///< how often

 private:
  static constexpr std::size_t kWindow = 500;  ///< ticks

  double rate_, tick_;
  Clock::time_point next_;
  std::deque<Clock::time_point> done_;
  std::uint64_t given_up_ = 0;
};

}  // namespace pilothouse
