#pragma once

#include <optional>

#include "core/pose/scan_matcher.hpp"

namespace pilothouse {

/// By how much the wheels count a way and a turn too large or too small, all the time: worn or soft
/// tyres, a track width that is not what it should be, a floor on which they slip. Learnt from how
/// far matches say that the robot went between them (Martinelli et al., Simultaneous localization
/// and odometry self calibration, 2007; here beside the pose's filter, not in it). Two Kalman
/// filters of one constant each. One thread at a time.
class WheelScale {
 public:
  double way() const { return way_.value; }    ///< true way of one that the wheels count
  double turn() const { return turn_.value; }  ///< and turn
  double wayVariance() const { return way_.variance; }
  double turnVariance() const { return turn_.variance; }

  /// An accepted match.
  /// @param match by the scan alone. @param odom T_odom_base at its time, as the wheels count.
  void learn(double stamp, const ScanMatch& match, const Pose2& odom);
  /// Odometry or poses to come have nothing to do with those before; what was learnt stays.
  void restart() { before_.reset(); }

 private:
  struct Constant {
    double value = 1.0;
    double variance = 0.1 * 0.1;
    void learn(double counted, double measured, double error_variance);
  };
  struct Sighting {
    double stamp;
    Pose2 matched, odom;
    Eigen::Matrix3d covariance;
  };

  Constant way_, turn_;
  std::optional<Sighting> before_;
};

}  // namespace pilothouse
