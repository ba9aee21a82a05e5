#pragma once

#include <Eigen/Geometry>
#include <vector>

namespace pilothouse::bench {

/// Something on the floor, seen from above: its convex hull.
class ConvexShape {
 public:
  /// @param points at least one [m].
  explicit ConvexShape(std::vector<Eigen::Vector2d> points);

  const std::vector<Eigen::Vector2d>& corners() const { return corners_; }  ///< counter-clockwise
  const Eigen::AlignedBox2d& bounds() const { return bounds_; }
  /// Least distance of the points between a and b from it [m]; 0 where they meet it.
  double distanceTo(const Eigen::Vector2d& a, const Eigen::Vector2d& b) const;
  double distanceTo(const Eigen::Vector2d& point) const { return distanceTo(point, point); }

 private:
  bool contains(const Eigen::Vector2d& point) const;

  std::vector<Eigen::Vector2d> corners_;
  Eigen::AlignedBox2d bounds_;
};

}  // namespace pilothouse::bench
