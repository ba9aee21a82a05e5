#pragma once

#include <string>

namespace pilothouse {

/// Keeps the process in memory and the calling thread before ordinary ones, as far as the system
/// permits. @return what it did not permit, for a human; empty: all done.
std::string becomeRealTime();

/// Wakes at fixed instants of the steady clock.
class SteadyPace {
 public:
  /// Sleeps until `period` [s] after the last wake-up; from now on where that has passed already,
  /// since steps that were missed are not made up for.
  void wait(double period);

 private:
  double next_ = 0.0;
};

}  // namespace pilothouse
