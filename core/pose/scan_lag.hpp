#pragma once

#include <deque>
#include <utility>
#include <vector>

#include "core/motion/planar.hpp"
#include "core/pose/scan_matcher.hpp"

namespace pilothouse {

/// How much earlier than stamped a sensor's scans were really taken: drivers stamp late, by what
/// the sensor and the wire take. Learnt from how the robot moved between two matches: what scans
/// say of it belongs to an earlier time than what odometry says. That shows only where the velocity
/// changed between them; a steady drive tells nothing and changes nothing. A Kalman filter of one
/// constant. One thread at a time.
class ScanLag {
 public:
  static constexpr double kMost = 0.15;  ///< either way [s]
  static constexpr double kWay = 0.1;    ///< odometry's way that learn() wants [s]

  /// [s], within +-kMost; to be taken off the stamps. Below 0: stamped early.
  double seconds() const { return lag_; }
  /// Standard deviation [s].
  double spread() const;
  /// An accepted match.
  /// @param stamp of the scan after the lag was taken off, not before those of earlier calls.
  /// @param match by the scan alone; what it leaves open tells nothing of the lag.
  /// @param way by odometry, in a frame fixed to the floor that stays the same from call to call;
  /// over the last kWay. Too short: nothing is learnt.
  void learn(double stamp, const ScanMatch& match,
             const std::vector<std::pair<double, Pose2>>& way);
  /// Matches to come have nothing to do with those before; the lag stays.
  void restart() { sightings_.clear(); }

 private:
  struct Sighting {
    double stamp;                ///< the lag taken off
    double lag;                  ///< that was taken off
    Pose2 matched;               ///< T_map_base
    Eigen::Matrix3d covariance;  ///< of that, in the map
    Pose2 driven;                ///< by odometry
    Twist2 twist;                ///< by odometry, in the base frame
  };
  void compare(const Sighting& before, const Sighting& now);

  std::deque<Sighting> sightings_;
  double lag_ = 0.0;
  double variance_ = 0.05 * 0.05;  ///< [s^2]
};

}  // namespace pilothouse
