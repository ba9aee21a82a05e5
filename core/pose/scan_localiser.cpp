#include "core/pose/scan_localiser.hpp"

#include <cmath>

#include "core/pose/pose_algebra.hpp"
#include "core/pose/scan_points.hpp"

namespace pilothouse {

void ScanLocaliser::give(const std::vector<MapPoint>& map) {
  given_ = true;
  given_points_ = map.size();
  restart();
  matcher_->setTarget(map);
}

void ScanLocaliser::restart() {
  scans_.clear();
  lag_.restart();
  keyframe_.reset();
  last_.clear();
}

ScanMatch ScanLocaliser::match(const std::vector<Eigen::Vector2d>& points, const Pose2& predicted,
                               const Eigen::Vector2d& from) {
  last_from_ = from;
  last_ = thinned(points, parameters_.thin);
  if (last_.size() < parameters_.fewest || mapped() < parameters_.fewest) return {};
  return matcher_->match(last_, predicted);
}

bool ScanLocaliser::isKeyframe(MatchVerdict verdict, const Pose2& pose) const {
  if (!keyframe_) return true;
  const bool good = verdict == MatchVerdict::kAccepted || verdict == MatchVerdict::kRelocated;
  // Where little of what is seen is in the map, odometry is all there is to go by.
  if (!good && verdict != MatchVerdict::kLittleOverlap) return false;
  const Pose2 moved = relative(*keyframe_, pose);
  return moved.position().norm() >= parameters_.keyframe_distance ||
         std::abs(moved.heading) >= parameters_.keyframe_turn;
}

void ScanLocaliser::learn(MatchVerdict verdict, const Pose2& pose) {
  if (given_ || last_.size() < parameters_.fewest || !isKeyframe(verdict, pose)) return;
  scans_.add(last_, pose, last_from_);
  keyframe_ = pose;
  matcher_->setTarget(scans_.points());
}

}  // namespace pilothouse
