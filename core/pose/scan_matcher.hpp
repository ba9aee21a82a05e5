#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "core/motion/planar.hpp"

namespace pilothouse {

/// A point of the map that scans are laid upon.
struct MapPoint {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< map [m]
  /// Unit, across the line that the points around form; zero where they form none.
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();
  /// Unit, along that line to where it ends here: what lies beyond has not been seen. Zero where it
  /// goes on both ways.
  Eigen::Vector2d beyond = Eigen::Vector2d::Zero();
};

/// Where a scan fits the map best.
struct ScanMatch {
  bool found = false;  ///< false: nothing to lay it upon, or the search came to no end
  Pose2 pose;          ///< T_map_base
  /// Of x, y [m] and heading [rad] in the map frame. Large along what the scan does not tell, as in
  /// a corridor.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();
  double rms = 0.0;      ///< of the distances of the scan's matched points from the map [m]
  double overlap = 0.0;  ///< share of the scan's points that have a match, 0..1
};

/// Lays scans upon a map of points.
class ScanMatcher {
 public:
  virtual ~ScanMatcher() = default;
  virtual void setTarget(const std::vector<MapPoint>& map) = 0;
  /// @param points in the base frame [m], finite. @param guess T_map_base to begin at.
  /// @param spread covariance of the guess, positive definite: what the scan leaves open stays near
  /// the guess, and nobody looks for the map farther off than that. What is found says nothing of
  /// the guess all the same.
  virtual ScanMatch match(const std::vector<Eigen::Vector2d>& points, const Pose2& guess,
                          const Eigen::Matrix3d& spread) = 0;
};

}  // namespace pilothouse
