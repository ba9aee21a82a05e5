#include "core/motion/pose_history.hpp"

namespace pilothouse {
namespace {

constexpr double kFarthestAhead = 0.3;  // [s]

}  // namespace

bool PoseHistory::add(double stamp, const Pose2& pose, const Twist2& twist) {
  if (!std::isfinite(stamp) || !pose.finite() || !twist.finite()) return false;
  if (size_ > 0 && stamp <= entry(0).stamp) return false;
  entries_[next_] = {stamp, pose};
  next_ = (next_ + 1) % kKept;
  if (size_ < kKept) ++size_;
  twist_ = twist;
  return true;
}

std::optional<double> PoseHistory::newest() const {
  if (size_ == 0) return std::nullopt;
  return entry(0).stamp;
}

std::optional<Pose2> PoseHistory::at(double stamp) const {
  if (size_ == 0 || !(stamp <= entry(0).stamp + kFarthestAhead)) return std::nullopt;
  if (stamp >= entry(0).stamp) return advanced(entry(0).pose, twist_, stamp - entry(0).stamp);
  for (std::size_t back = 1; back < size_; ++back) {
    const Entry& before = entry(back);
    if (stamp < before.stamp) continue;
    const Entry& after = entry(back - 1);
    const double share = (stamp - before.stamp) / (after.stamp - before.stamp);
    return Pose2{
        before.pose.x + share * (after.pose.x - before.pose.x),
        before.pose.y + share * (after.pose.y - before.pose.y),
        wrapped(before.pose.heading + share * wrapped(after.pose.heading - before.pose.heading))};
  }
  return std::nullopt;
}

}  // namespace pilothouse
