#pragma once

#include <atomic>
#include <cstdint>

namespace pilothouse::gui {

/// The robot's ROS time. roscpp's own is of no use here: it asks once whether time is simulated,
/// perhaps before the launch file has said so, and stands still after the master was replaced.
class RobotClock {
 public:
  /// @param nanoseconds of /clock; < 0: time is not simulated.
  void set(std::int64_t nanoseconds) { simulated_ = nanoseconds; }
  /// Nanoseconds of simulated time; < 0: use the wall clock.
  std::int64_t simulated() const { return simulated_; }

 private:
  std::atomic<std::int64_t> simulated_{-1};
};

}  // namespace pilothouse::gui
