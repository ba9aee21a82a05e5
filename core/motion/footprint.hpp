#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace pilothouse {

/// The robot's outline on the floor, base frame. Convex: of what is given the convex hull is used,
/// which errs to the safe side.
class Footprint {
 public:
  struct Edge {
    Eigen::Vector2d normal;  ///< unit, outward
    double offset;           ///< normal . p <= offset within [m]
    Eigen::Vector2d from, to;
  };

  /// @param corners at least three, finite, not all on a line [m].
  /// @throws std::invalid_argument otherwise.
  explicit Footprint(const std::vector<Eigen::Vector2d>& corners);

  const std::vector<Eigen::Vector2d>& corners() const { return corners_; }  ///< counter-clockwise
  const std::vector<Edge>& edges() const { return edges_; }
  /// Farthest corner from a point of the base frame [m].
  double farthestFrom(const Eigen::Vector2d& point) const;
  /// Distance of a point from the outline [m]; negative within.
  double distanceTo(const Eigen::Vector2d& point) const;

 private:
  std::vector<Eigen::Vector2d> corners_;
  std::vector<Edge> edges_;
};

}  // namespace pilothouse
