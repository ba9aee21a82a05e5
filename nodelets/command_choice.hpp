#pragma once

#include <algorithm>
#include <limits>
#include <string>

#include "core/motion/planar.hpp"

namespace pilothouse {

/// Chooses between what a person wants and what a task wants: the person wins while their wish is
/// fresh. Times are of two clocks: stamps by that of who wished (a console's may go wrong),
/// arrivals by the steady one. A stamp that is not newer than the last refreshes nothing; an older
/// one does after a silence, for the clock of who wished may have been set back.
class CommandChoice {
 public:
  enum Source { kTeleop = 0, kTask = 1 };
  struct Wish {
    const char* source = "";  ///< teleop, task, or empty: none ever came
    Twist2 twist;
    double stamp = 0.0;  ///< when it was made, by the clock of who made it [s]
    double age = std::numeric_limits<double>::infinity();  ///< since it arrived [s]
  };
  static constexpr double kFresh = 0.5;    ///< [s]
  static constexpr double kSilence = 1.0;  ///< without a newer stamp [s]

  /// @return false when it was refused: no newer than the last one of that source.
  bool take(Source source, const Twist2& twist, double stamp, double arrival) {
    Kept& kept = kept_[source];
    const bool set_back = stamp < kept.stamp && arrival - kept.arrival > kSilence;
    if (!(stamp > kept.stamp) && !(stamp > 0.0 && set_back)) return false;
    kept = {twist, stamp, arrival};
    return true;
  }
  /// Where neither is fresh, the one that came last, whatever its age.
  Wish choose(double now) const {
    const Wish teleop = wish(kTeleop, "teleop", now), task = wish(kTask, "task", now);
    if (teleop.age <= kFresh) return teleop;
    return task.age <= teleop.age ? task : teleop;
  }
  void clear() { *this = {}; }

 private:
  struct Kept {
    Twist2 twist;
    double stamp = 0.0, arrival = -std::numeric_limits<double>::infinity();
  };
  Wish wish(Source source, const char* name, double now) const {
    const Kept& kept = kept_[source];
    if (!(kept.stamp > 0.0)) return {};
    return {name, kept.twist, kept.stamp, std::max(0.0, now - kept.arrival)};
  }
  Kept kept_[2];
};

}  // namespace pilothouse
