#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/pose/gyro_angle.hpp"
#include "core/pose/scan_matcher.hpp"
#include "core/pose/tracker_parameters.hpp"
#include "core/pose/wheel_scale.hpp"

namespace pilothouse {

/// Where the robot is in the map.
struct PoseEstimate {
  double stamp = 0.0;  ///< [s]
  Pose2 pose;          ///< T_map_base
  /// Of x, y [m] and heading [rad], in the map frame.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

enum class OdometryVerdict {
  kTaken,
  kNotFinite,
  kOld,       ///< not newer than the newest: not taken
  kJumped,    ///< taken; the base began to count anew, the pose in the map stays
  kTimeBack,  ///< taken; time ran back, what was known of earlier times is forgotten
};

enum class MatchVerdict {
  kAccepted,
  kRelocated,  ///< accepted against odometry, since all matches have agreed for a while
  kNotFound,
  kPoorFit,
  kLittleOverlap,
  kUncertain,  ///< leaves too much open
  kUnlikely,   ///< too far from where the robot can be
  kNoTrack,    ///< no odometry at its time
};
const char* nameOf(MatchVerdict verdict);

/// Dead reckoning from odometry, freed from what the wheels miscount all the time, turned by the
/// gyroscope where there is one, corrected by matches of scans with the map: an extended Kalman
/// filter on x, y, heading that lays a late match upon the time at which its scan was taken and
/// counts on from there (Thrun et al., Probabilistic Robotics, 2005, ch. 3 and 7). Time is an
/// argument. One thread at a time.
class PoseTracker {
 public:
  explicit PoseTracker(const TrackerParameters& parameters) : parameters_(parameters) {}

  /// The first odometry begins where the robot was set, else with the map's origin on odometry's.
  OdometryVerdict addOdometry(double stamp, const Pose2& T_odom_base);
  /// About the vertical axis. @return false when refused: not finite or not newer.
  bool addGyro(double stamp, double rate) { return gyro_.add(stamp, rate); }

  /// A pose set by hand, at a time that may be past; out of the known times it counts for the
  /// newest. @return the reason of a refusal, after which nothing has changed.
  std::optional<std::string> setPose(const PoseEstimate& estimate);
  /// What a scan taken at `stamp` says.
  MatchVerdict correct(double stamp, const ScanMatch& match);

  bool known() const { return !entries_.empty(); }
  /// At the newest odometry; must be known().
  PoseEstimate newest() const;
  /// Nothing where odometry does not reach.
  std::optional<PoseEstimate> at(double stamp) const;
  /// T_map_odom at the newest odometry; must be known().
  Pose2 correction() const;
  /// The way over the time by odometry and gyroscope alone, in a frame fixed to the floor; nothing
  /// where it is not known.
  std::optional<std::vector<std::pair<double, Pose2>>> way(double from, double to) const;
  /// Squared Mahalanobis distance of the last match that came so far as to be compared.
  double lastDistance() const { return last_distance_; }
  /// Rises with each pose that was set by hand or lost to time: matches begun before are void.
  std::uint64_t epoch() const { return epoch_; }
  /// What the wheels count too much or too little all the time.
  const WheelScale& scale() const { return scale_; }

 private:
  struct Entry {
    double stamp;
    Pose2 odom;
    Pose2 reckoned;  ///< by odometry and gyroscope alone, from anywhere
    Pose2 map;
    Eigen::Matrix3d covariance;
    double turn_variance;  ///< of the step from the entry before [rad^2]
  };
  struct Step {
    Pose2 delta;  ///< in the frame of its begin
    double turn_variance;
  };
  Step stepTo(double stamp, const Pose2& T_odom_base);
  Eigen::Matrix3d grown(const Eigen::Matrix3d& covariance, const Pose2& from, const Pose2& to,
                        double turn_variance) const;
  /// The first entry not before the stamp, and the estimate there.
  std::optional<std::pair<std::size_t, PoseEstimate>> find(double stamp) const;
  void replace(std::size_t next, const PoseEstimate& before, const PoseEstimate& after);
  /// As the wheels count, between the entries.
  Pose2 odometryAt(std::size_t next, double stamp) const;
  MatchVerdict judge(const PoseEstimate& predicted, const ScanMatch& match);
  bool agreesWithRefused(const PoseEstimate& predicted, const ScanMatch& match);

  TrackerParameters parameters_;
  GyroAngle gyro_;
  WheelScale scale_;
  double jumped_at_ = -INFINITY;  ///< odometry began anew there [s]
  std::deque<Entry> entries_;
  std::optional<PoseEstimate> pending_;  ///< set before any odometry
  Pose2 refused_shift_;                  ///< T_map_new: what the first of the refused asks for
  int refused_ = 0;                      ///< in a row, agreeing
  double refused_since_ = 0.0, refused_last_ = 0.0;  ///< stamps [s]
  double slip_ = 1.0;  ///< odometry's variance is so many times what it should be
  double last_distance_ = 0.0;
  std::uint64_t epoch_ = 0;
};

}  // namespace pilothouse
