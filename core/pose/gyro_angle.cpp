#include "core/pose/gyro_angle.hpp"

#include <algorithm>
#include <cmath>

namespace pilothouse {
namespace {

constexpr double kKept = 5.0;     // [s]
constexpr double kBeyond = 0.05;  // the newest rate still holds for so long [s]
constexpr double kGap = 0.2;      // readings farther apart say nothing of the time between [s]
constexpr double kNoise = 0.001;  // of an angle, over a second [rad]
constexpr double kWander =
    1e-4;  // of the constant error, which warms and cools, in a second [rad/s]
constexpr double kStraight = 0.1;  // so slow a turn is none [rad/s]

}  // namespace

bool GyroAngle::add(double stamp, double rate) {
  if (!std::isfinite(stamp) || !std::isfinite(rate)) return false;
  if (readings_.empty()) {
    readings_.push_back({stamp, rate, 0.0});
    return true;
  }
  const Reading& last = readings_.back();
  if (stamp <= last.stamp) return false;
  if (stamp - last.stamp > kGap) {
    readings_.clear();
    readings_.push_back({stamp, rate, 0.0});
    return true;
  }
  readings_.push_back({stamp, rate, last.angle + 0.5 * (last.rate + rate) * (stamp - last.stamp)});
  while (readings_.back().stamp - readings_.front().stamp > kKept) readings_.pop_front();
  return true;
}

std::optional<double> GyroAngle::angleAt(double stamp) const {
  if (readings_.empty() || stamp < readings_.front().stamp - kBeyond ||
      stamp > readings_.back().stamp + kBeyond) {
    return std::nullopt;
  }
  const auto after =
      std::lower_bound(readings_.begin(), readings_.end(), stamp,
                       [](const Reading& r, double wanted) { return r.stamp < wanted; });
  if (after == readings_.end()) {
    return readings_.back().angle + readings_.back().rate * (stamp - readings_.back().stamp);
  }
  // Back from the reading after: its own rate is near enough for a part of 10 ms.
  return after->angle + after->rate * (stamp - after->stamp);
}

std::optional<double> GyroAngle::turned(double from, double to) const {
  const auto begin = angleAt(from), end = angleAt(to);
  if (!begin || !end) return std::nullopt;
  return *end - *begin - bias_ * (to - from);
}

/// A Kalman filter of one constant. @param error of the angle over the time, @param variance of it.
void GyroAngle::learn(double error, double time, double variance) {
  bias_variance_ += kWander * kWander * time;
  const double gain = bias_variance_ / (bias_variance_ + variance / (time * time));
  bias_ += gain * error / time;
  bias_variance_ *= 1.0 - gain;
}

void GyroAngle::stood(double from, double to) {
  const auto turn = turned(from, to);
  if (turn && to > from) learn(*turn, to - from, kNoise * kNoise * (to - from));
}

void GyroAngle::rolled(double from, double to, double turned_by_wheels, double variance) {
  const auto turn = turned(from, to);
  // What slips in a turn would pass for a constant error.
  if (!turn || !(to > from) || std::abs(turned_by_wheels) > kStraight * (to - from)) return;
  learn(*turn - turned_by_wheels, to - from, variance);
}

}  // namespace pilothouse
