#pragma once

#include <cstddef>
#include <map>
#include <string>

namespace pilothouse::gui {

/// Notices that transforms begin anew though no clock does: a bag that is played again without
/// /clock. tf2 would refuse every one of them as old, and what it knows would stand still for ever.
class RewindWatch {
 public:
  static constexpr double kBack = 1.0;  ///< [s]; more than a late publisher is behind
  static constexpr int kTimes = 3;      ///< in a row: one lost message of before is no beginning

  /// @param frame whose transform came. @param stamp its time [s]. @return time went back.
  bool rewound(const std::string& frame, double stamp) {
    const auto found = frames_.find(frame);
    if (found == frames_.end()) {
      if (frames_.size() < kMostFrames) frames_[frame] = {stamp, 0};
      return false;
    }
    Newest& newest = found->second;
    if (stamp < newest.stamp - kBack) {
      if (++newest.behind < kTimes) return false;
      frames_.clear();
      return true;
    }
    newest.behind = 0;
    if (stamp > newest.stamp) newest.stamp = stamp;
    return false;
  }

 private:
  static constexpr std::size_t kMostFrames = 1000;
  struct Newest {
    double stamp;
    int behind;
  };
  std::map<std::string, Newest> frames_;
};

}  // namespace pilothouse::gui
