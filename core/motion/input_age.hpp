#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace pilothouse {

/// One instant by two clocks.
struct GateTime {
  double steady = 0.0;  ///< never jumps [s]
  double ros = 0.0;     ///< that of the robot's stamps, may jump or be simulated [s]
};

/// A message that came in: the stamp of its original, and when it was first held in hand.
struct Arrival {
  double stamp = 0.0;    ///< [s]; 0 or NaN: none
  double arrival = 0.0;  ///< steady clock [s]
};

/// Age of the newest original of one input. A stamp that was seen before, is older than one seen,
/// or lies in the future refreshes nothing, so that neither a repeater nor a replay keeps an input
/// alive.
class InputAge {
 public:
  /// @param future stamps may be this far ahead of the clock [s].
  void take(const Arrival& message, const GateTime& now, double future) {
    const bool newer = message.stamp > 0.0 && message.stamp > newest_.stamp;
    if (newer && message.stamp <= now.ros + future && message.arrival <= now.steady)
      newest_ = message;
  }
  /// By the clock that says more [s]; infinite: never came.
  double at(const GateTime& now) const {
    if (!(newest_.stamp > 0.0)) return std::numeric_limits<double>::infinity();
    const double age = std::max(now.steady - newest_.arrival, now.ros - newest_.stamp);
    return std::isnan(age) ? std::numeric_limits<double>::infinity() : std::max(age, 0.0);
  }
  void forget() { newest_ = {}; }

 private:
  Arrival newest_;
};

}  // namespace pilothouse
