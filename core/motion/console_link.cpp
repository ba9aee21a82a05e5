#include "core/motion/console_link.hpp"

#include <algorithm>
#include <cmath>

namespace pilothouse {
namespace {

constexpr double kDrift = 1e-3;       // clocks run apart by no more [s/s]
constexpr double kContradict = 0.02;  // bounds that cross by more tell of a jump [s]
constexpr double kInfinite = std::numeric_limits<double>::infinity();

}  // namespace

void ConsoleLink::take(const ConsoleMessage& message, const BeatTimes& beats, double now) {
  if (message.slot_use != slot_use_) {
    *this = ConsoleLink();
    slot_use_ = message.slot_use;
  }
  if (message.slot_use == 0 || message.count == count_) return;
  count_ = message.count;
  heard_ = now;
  if (message.stops != stops_) stop_taken_ = false;
  stops_ = message.stops;
  stop_ = message.stop;
  left_ = message.leaving;
  const double beat_time = beats.of(message.gate_beat);
  if (!std::isfinite(beat_time)) return;
  newest_beat_ = std::max(newest_beat_, beat_time);
  if (message.driving) driven_ = now;
  boundClock(beat_time, message.arrival, message.stamp);
}

// It was sent after the beat that it knows and before it arrived.
void ConsoleLink::boundClock(double beat_time, double arrival, double stamp) {
  if (!std::isfinite(stamp) || !std::isfinite(arrival)) return;
  const double drift = kDrift * std::max(arrival - bounded_, 0.0);
  low_ = std::max(low_ - drift, beat_time - stamp);
  high_ = std::min(high_ + drift, arrival - stamp);
  bounded_ = arrival;
  if (low_ <= high_ + kContradict) return;
  low_ = beat_time - stamp;
  high_ = arrival - stamp;
}

double ConsoleLink::age(double now) const {
  return used() && std::isfinite(newest_beat_) ? std::max(now - newest_beat_, 0.0) : kInfinite;
}

double ConsoleLink::commandAge(double stamp, double now) const {
  if (!std::isfinite(low_) || !std::isfinite(stamp)) return kInfinite;
  if (stamp + low_ > now + 0.1) return kInfinite;  // not even its own clock has come that far
  return std::max(now - (stamp + low_), 0.0);
}

bool ConsoleLink::takeStop() {
  const bool fresh = !stop_taken_;
  stop_taken_ = true;
  return fresh;
}

}  // namespace pilothouse
