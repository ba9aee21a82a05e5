#include "core/pose/scan_localiser.hpp"

#include <algorithm>
#include <cmath>

#include "core/pose/pose_algebra.hpp"
#include "core/pose/scan_points.hpp"

namespace pilothouse {
namespace {

constexpr int kLost = 10;  // scans in a row that were refused
const Eigen::Matrix3d kAnywhere = Eigen::Vector3d(1.0, 1.0, 1.0).asDiagonal();
// Nobody knows better, however sure the tracker is: of the map, not of the robot.
const Eigen::Matrix3d kAtLeast = Eigen::Vector3d(1e-4, 1e-4, 1e-4).asDiagonal();

bool isGood(MatchVerdict verdict) {
  return verdict == MatchVerdict::kAccepted || verdict == MatchVerdict::kRelocated;
}

}  // namespace

void ScanLocaliser::give(const std::vector<MapPoint>& map) {
  given_ = true;
  given_points_ = map.size();
  restart();
  matcher_->setTarget(map);
}

void ScanLocaliser::restart() {
  scans_.clear();
  lag_.restart();
  refused_ = 0;
  keyframe_.reset();
  last_.clear();
}

ScanMatch ScanLocaliser::match(const std::vector<Eigen::Vector2d>& points,
                               const PoseEstimate& predicted, const Eigen::Vector2d& from) {
  last_from_ = from;
  last_ = thinned(points, parameters_.thin);
  if (last_.size() < parameters_.fewest || mapped() < parameters_.fewest) return {};
  // Who is refused again and again is not where it believes to be.
  if (refused_ >= kLost) return matcher_->match(last_, predicted.pose, kAnywhere);
  return matcher_->match(last_, predicted.pose, predicted.covariance + kAtLeast);
}

bool ScanLocaliser::isKeyframe(MatchVerdict verdict, const Pose2& pose) const {
  if (!keyframe_) return true;
  // Where little of what is seen is in the map, odometry is all there is to go by.
  if (!isGood(verdict) && verdict != MatchVerdict::kLittleOverlap) return false;
  const Pose2 moved = relative(*keyframe_, pose);
  return moved.position().norm() >= parameters_.keyframe_distance ||
         std::abs(moved.heading) >= parameters_.keyframe_turn;
}

void ScanLocaliser::learn(MatchVerdict verdict, const Pose2& pose) {
  if (isGood(verdict)) refused_ = 0;
  const bool elsewhere = verdict == MatchVerdict::kUnlikely || verdict == MatchVerdict::kPoorFit ||
                         verdict == MatchVerdict::kLittleOverlap;
  if (elsewhere) refused_ = std::min(refused_ + 1, kLost);
  if (given_ || last_.size() < parameters_.fewest || !isKeyframe(verdict, pose)) return;
  scans_.add(last_, pose, last_from_);
  keyframe_ = pose;
  matcher_->setTarget(scans_.points());
}

}  // namespace pilothouse
