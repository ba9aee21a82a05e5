#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "core/motion/planar.hpp"

namespace pilothouse {

/// The base's pose at a time, from odometry.
class PoseHistory {
 public:
  /// @return false when refused: not finite, or not newer than the newest (where time ran back, the
  /// caller clears).
  bool add(double stamp, const Pose2& pose, const Twist2& twist);
  /// Interpolated; beyond the newest by at most 0.3 s with its twist. Nothing where unknown.
  std::optional<Pose2> at(double stamp) const;
  std::optional<double> newest() const;
  Twist2 twist() const { return twist_; }
  void clear() { size_ = 0; }

 private:
  static constexpr std::size_t kKept = 256;
  struct Entry {
    double stamp;
    Pose2 pose;
  };
  /// @param back 0: the newest.
  const Entry& entry(std::size_t back) const {
    return entries_[(next_ + kKept - 1 - back) % kKept];
  }

  std::array<Entry, kKept> entries_{};
  std::size_t next_ = 0, size_ = 0;
  Twist2 twist_;
};

}  // namespace pilothouse
