#pragma once

#include <deque>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "gui/model/drive_readings.hpp"
#include "gui/model/trace.hpp"

namespace pilothouse::gui {

/// What rules the speed over a stretch of time, for the band above the speed graph.
enum class Rule : unsigned char {
  kFree,
  kObstacle,
  kPotential,
  kBraking,
  kThreshold,
  kUnseen,
  kStale,
  kBadCommand,
  kStopped,
};

/// A stretch of time over which a rule held for one reason, as far as it was reported.
struct RuleStretch {
  double at, until;  ///< first and last report, or where the next rule began; steady [s]
  Rule rule;
  std::string words;  ///< for the cursor, as they began
};

/// The curves of the graphs. Filled by the ROS side, read by the panels.
class Telemetry {
 public:
  static constexpr std::size_t kMostNames = 16;      ///< wheels, rangers
  static constexpr std::size_t kMostChanges = 2000;  ///< stretches of a rule

  struct Curves {
    Trace wanted, limited, measured, limit;  ///< [m/s]
    std::map<std::string, Trace> wheels;     ///< [rad/s]
    Trace obstacle, potential;               ///< free way [m]
    std::map<std::string, Trace> ranges;     ///< [m]
    std::deque<RuleStretch> rules;           ///< between them nobody told
  };

  void limit(double now, const LimitReading& reading);
  void stop(double now, const StopReading& reading);
  void wheels(double now, const std::vector<WheelReading>& wheels);
  void range(double now, const RangeReading& reading);

  /// Calls `look` with the curves while nothing changes them; must be short.
  template <class Look>
  void read(Look&& look) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    look(static_cast<const Curves&>(curves_));
  }

 private:
  void rule(double now, Rule rule, const std::string& words);

  mutable std::mutex mutex_;
  Curves curves_;
  double stopped_at_ = -1e9;  ///< the gate last said so; -1e9: it has let go
};

}  // namespace pilothouse::gui
