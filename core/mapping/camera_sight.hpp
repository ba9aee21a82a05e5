#pragma once

#include <Eigen/Geometry>

#include "core/cloud/depth_view.hpp"

namespace pilothouse {

/// What a depth camera could see, whether or not anything is there.
struct CameraSight {
  Eigen::Isometry3d T_base_optical = Eigen::Isometry3d::Identity();  ///< x right, y down, z forward
  Intrinsics intrinsics;
  double width = 0.0, height = 0.0;  ///< of the picture [pixels]
  double nearest = 0.8;              ///< nearer than this along the axis it measures nothing [m]

  /// Whether a point of the base frame lies in the picture, a little off its rim.
  bool sees(const Eigen::Vector3d& p_base) const {
    constexpr double kRim = 4.0;  // [pixels]
    const Eigen::Vector3d p = T_base_optical.inverse(Eigen::Isometry) * p_base;
    if (!(p.z() >= nearest)) return false;
    const double u = intrinsics.fx * p.x() / p.z() + intrinsics.cx;
    const double v = intrinsics.fy * p.y() / p.z() + intrinsics.cy;
    return u >= kRim && v >= kRim && u <= width - kRim && v <= height - kRim;
  }
};

}  // namespace pilothouse
