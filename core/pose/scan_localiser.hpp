#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/pose/point_map.hpp"
#include "core/pose/pose_tracker.hpp"
#include "core/pose/scan_lag.hpp"
#include "core/pose/scan_matcher.hpp"

namespace pilothouse {

struct LocaliserParameters {
  double thin = 0.05;               ///< a scan keeps one point a square of this side [m]
  double keyframe_distance = 0.25;  ///< a scan enters the map after so much way [m]
  double keyframe_turn = 0.12;      ///< or turn [rad]
  std::size_t fewest = 10;          ///< points, of a scan or map that says anything
  PointMapParameters map;
};

/// Lays the scans of one sensor upon what that sensor has met before, or upon a given map. A sensor
/// of its own has a map of its own: what stands at its height is not what stands at another's.
/// Slow: not for a thread that others wait for.
class ScanLocaliser {
 public:
  ScanLocaliser(const LocaliserParameters& parameters, std::unique_ptr<ScanMatcher> matcher)
      : parameters_(parameters), matcher_(std::move(matcher)), scans_(parameters.map) {}

  /// From now on scans are laid upon these points and enter no map.
  void give(const std::vector<MapPoint>& map);
  /// Forgets its own map; a given one stays.
  void restart();
  /// @param points in the base frame [m], not thinned. @param predicted where the robot may be.
  /// @param from where the sensor sits, base frame [m].
  ScanMatch match(const std::vector<Eigen::Vector2d>& points, const PoseEstimate& predicted,
                  const Eigen::Vector2d& from = Eigen::Vector2d::Zero());
  /// What became of the last match. @param pose T_map_base after it, or predicted where it was
  /// refused: new places enter the map, and so does the first scan.
  void learn(MatchVerdict verdict, const Pose2& pose);
  /// Of this sensor's stamps.
  ScanLag& lag() { return lag_; }
  /// What the scans have met so far.
  std::vector<MapPoint> map() const { return scans_.points(); }
  /// Points of the map.
  std::size_t mapped() const { return given_ ? given_points_ : scans_.size(); }

 private:
  bool isKeyframe(MatchVerdict verdict, const Pose2& pose) const;

  LocaliserParameters parameters_;
  std::unique_ptr<ScanMatcher> matcher_;
  ScanLag lag_;
  PointMap scans_;
  bool given_ = false;
  std::size_t given_points_ = 0;
  std::vector<Eigen::Vector2d> last_;  ///< thinned
  Eigen::Vector2d last_from_ = Eigen::Vector2d::Zero();
  std::optional<Pose2> keyframe_;
  int refused_ = 0;  ///< scans in a row that did not fit where the robot was thought to be
};

}  // namespace pilothouse
