#pragma once

#include <Eigen/Geometry>

#include "core/floor/floor_surface.hpp"

namespace pilothouse {

/// The camera's mounting as the floor shows it. Angles of the camera's view axis, by REP 103: pitch
/// positive looks down, roll positive leans to the right.
struct MountingEstimate {
  bool valid = false;                                              ///< enough frames agree
  int frames = 0;                                                  ///< frames used
  double height = 0.0, pitch = 0.0, roll = 0.0;                    ///< estimated [m, rad, rad]
  double height_error = 0.0, pitch_error = 0.0, roll_error = 0.0;  ///< estimated - configured
};

/// Estimates height, pitch and roll of a camera from the floor that it sees. What the floor cannot
/// show (x, y, yaw) stays as configured.
class MountingCalibrator {
 public:
  /// Forgets everything.
  void reset();

  /// The configured mounting corrected by what is known so far.
  Eigen::Isometry3f corrected(const Eigen::Isometry3f& T_base_optical) const;

  /// Learns from the floor at the robot, seen in a grid that was made with `T_used`, a correction
  /// of `T_configured`.
  void add(const FloorSlope& plane, const Eigen::Isometry3f& T_used,
           const Eigen::Isometry3f& T_configured);

  const MountingEstimate& estimate() const { return estimate_; }

 private:
  void describe(const Eigen::Isometry3f& T_configured);

  Eigen::Vector3d up_ = Eigen::Vector3d::Zero();  // floor normal in the optical frame
  double height_ = 0.0;                           // of the camera above the floor [m]
  MountingEstimate estimate_;
};

}  // namespace pilothouse
