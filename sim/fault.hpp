#pragma once

#include <deque>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "sim/random.hpp"

namespace pilothouse::sim {

enum class FaultKind { kNone, kFreeze, kStand, kDrop, kDelay, kCorrupt };
/// @param name none, freeze, stand, drop, delay or corrupt. None: no such kind.
std::optional<FaultKind> faultKind(const std::string& name);

/// What is wrong with a sensor.
struct Fault {
  FaultKind kind = FaultKind::kNone;
  double amount = 0.0;  ///< delay [s]; share of readings dropped or corrupted, 0: all
  double until = std::numeric_limits<double>::infinity();  ///< simulated time [s]
};

template <class T>
struct Reading {
  double stamp;  ///< when it was measured, simulated time [s]
  T value;
};

/// The way of one sensor's readings to whoever wants them, where faults happen.
template <class T>
class SensorChannel {
 public:
  using Corrupt = std::function<void(T& value, Random& random)>;
  using Still = std::function<void(T& value)>;

  /// @param still makes of a value one of a robot that stands there; null: it is one.
  SensorChannel(std::uint64_t seed, Corrupt corrupt, Still still = nullptr)
      : random_(seed), corrupt_(std::move(corrupt)), still_(std::move(still)) {}

  /// From now on. What another fault holds back is lost: it would hold back what comes after it.
  void fail(const Fault& fault) {
    fault_ = fault;
    under_way_.clear();
  }
  bool failing(double now) const { return kindAt(now) != FaultKind::kNone; }
  /// Whether offer() wants a fresh value, which may cost much to measure.
  bool wantsValue(double now) const {
    return !(repeats(kindAt(now)) && last_) &&
           !(kindAt(now) == FaultKind::kDrop && fault_.amount <= 0.0);
  }
  /// A sensor's turn has come. @param measure called if its value is wanted.
  template <class Measure>
  void offer(double now, Measure measure) {
    const FaultKind kind = kindAt(now);
    // Drawn in any case: a fault does not change what is random after it.
    const double luck = random_.unit();
    const bool hit = fault_.amount <= 0.0 || luck < fault_.amount;
    if (kind == FaultKind::kDrop && hit) return;
    if (!(repeats(kind) && last_)) last_ = measure();
    T value = *last_;
    if (kind == FaultKind::kStand && still_) still_(value);
    if (kind == FaultKind::kCorrupt && hit) corrupt_(value, random_);
    const double due = kind == FaultKind::kDelay ? now + fault_.amount : now;
    if (kind != FaultKind::kDelay) under_way_.clear();  // of a delay that ended by itself
    under_way_.push_back({due, {now, std::move(value)}});
  }
  /// What arrives now. As all are held back equally long, no more come at a time than were offered.
  std::optional<Reading<T>> take(double now) {
    if (under_way_.empty() || under_way_.front().first > now + 1e-9) return std::nullopt;
    std::optional<Reading<T>> reading = std::move(under_way_.front().second);
    under_way_.pop_front();
    return reading;
  }

 private:
  static bool repeats(FaultKind kind) {
    return kind == FaultKind::kFreeze || kind == FaultKind::kStand;
  }
  FaultKind kindAt(double now) const { return now < fault_.until ? fault_.kind : FaultKind::kNone; }

  Random random_;
  Corrupt corrupt_;
  Still still_;
  Fault fault_;
  std::optional<T> last_;
  std::deque<std::pair<double, Reading<T>>> under_way_;
};

}  // namespace pilothouse::sim
