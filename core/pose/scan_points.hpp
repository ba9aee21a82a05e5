#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "core/motion/planar.hpp"

namespace pilothouse {

/// One scan of a laser (or of the virtual one), as it came.
struct ScanBeams {
  double stamp = 0.0;                       ///< of the first beam [s]
  double angle_min = 0.0;                   ///< of the first beam, in the sensor's frame [rad]
  double angle_increment = 0.0;             ///< negative: clockwise [rad]
  double time_increment = 0.0;              ///< between beams, >= 0 [s]; 0: all at once
  double range_min = 0.0, range_max = 0.0;  ///< of measurements [m]
  std::vector<float> ranges;                ///< [m]; NaN, infinite or out of range: no measurement

  double end() const {
    return stamp + time_increment * static_cast<double>(ranges.empty() ? 0 : ranges.size() - 1);
  }
};

/// How a sensor sits on the robot; z, roll and pitch are not needed, as long as the sensor's plane
/// is level. An upside-down one turns the other way.
struct ScanMounting {
  Pose2 T_base_sensor;
  bool upside_down = false;
};

/// The robot's way over some time.
class TrackPiece {
 public:
  /// @param poses stamps [s] rising, in a frame fixed to the floor; not empty.
  explicit TrackPiece(std::vector<std::pair<double, Pose2>> poses) : poses_(std::move(poses)) {}
  /// Interpolated; beyond the ends the last one.
  Pose2 at(double stamp) const;

 private:
  std::vector<std::pair<double, Pose2>> poses_;
};

/// The measured points as if all had been seen at `reference` [s], in the base frame at that time
/// [m]: what the robot moved between the beams is taken out by its track.
std::vector<Eigen::Vector2d> pointsOf(const ScanBeams& scan, const ScanMounting& mounting,
                                      const TrackPiece& track, double reference);

/// At most one point a square of `cell` [m] (> 0): the mean of those in it.
std::vector<Eigen::Vector2d> thinned(const std::vector<Eigen::Vector2d>& points, double cell);

}  // namespace pilothouse
