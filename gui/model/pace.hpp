#pragma once

#include <algorithm>

namespace pilothouse::gui {

/// Lets pictures be drawn at most 30 times a second on average. Two may follow each other closely:
/// a camera of 30 Hz jitters, and a fixed beat beside it would lose a good part of its pictures.
class Pace {
 public:
  /// Whether a picture may be drawn now; if so it counts. @param now steady time [s].
  bool due(double now) {
    credit_ = std::min(kMostCredit, credit_ + std::max(0.0, now - last_) * kPerSecond);
    last_ = now;
    if (credit_ < 1.0) return false;
    credit_ -= 1.0;
    return true;
  }

 private:
  static constexpr double kPerSecond = 30.3;  // a camera's 30 Hz is never exact
  static constexpr double kMostCredit = 2.0;
  double credit_ = kMostCredit;
  double last_ = 0.0;
};

}  // namespace pilothouse::gui
