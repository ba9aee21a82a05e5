#include "nodelets/simulator_pace.hpp"

namespace pilothouse {
namespace {

/// Later than this the past is given up [s].
constexpr double kTooLate = 0.25;

using Seconds = std::chrono::duration<double>;

SimulatorPace::Clock::duration clockSeconds(double seconds) {
  return std::chrono::duration_cast<SimulatorPace::Clock::duration>(Seconds(seconds));
}

}  // namespace

void SimulatorPace::start(Clock::time_point now) {
  done_.clear();
  next_ = now;
}

void SimulatorPace::ticked(Clock::time_point now) {
  done_.push_back(now);
  if (done_.size() > kWindow) done_.pop_front();
  if (rate_ <= 0.0) return;
  next_ += clockSeconds(tick_ / rate_);
  if (Seconds(now - next_).count() <= kTooLate) return;
  next_ = now;
  ++given_up_;
}

double SimulatorPace::factor() const {
  if (done_.size() < 2) return 0.0;
  const double seconds = Seconds(done_.back() - done_.front()).count();
  return seconds > 0.0 ? static_cast<double>(done_.size() - 1) * tick_ / seconds : 0.0;
}

}  // namespace pilothouse
