#pragma once

#include <Eigen/Core>
#include <vector>

#include "bench/convex_shape.hpp"

namespace pilothouse::bench {

/// How finely ways are led round corners [rad].
constexpr double kCornerStep = 3.75 * 3.14159265358979 / 180.0;

/// Length of the shortest way of a point that keeps `radius` off all shapes [m]; infinite where
/// there is none. A visibility graph over points on the arcs round the shapes' corners
/// (Lozano-Perez and Wesley 1979), taken by A*: no longer than the shortest way for `radius`, no
/// shorter than the one for `radius` * cos(kCornerStep), which is 0.2 % less.
double shortestWay(const std::vector<ConvexShape>& shapes, double radius,
                   const Eigen::Vector2d& start, const Eigen::Vector2d& goal);

/// Where a disc can get to from its start, pushed in steps to the side and aslant: it keeps off the
/// shapes wherever it stops.
class DiscReach {
 public:
  DiscReach(const std::vector<ConvexShape>& shapes, double radius, const Eigen::Vector2d& start);
  /// Whether it can get to within a step of the place.
  bool reaches(const Eigen::Vector2d& place) const;

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size_x_) +
           static_cast<std::size_t>(x);
  }
  Eigen::Vector2d start_;
  int min_x_ = 0, min_y_ = 0, size_x_ = 0, size_y_ = 0;
  std::vector<char> reached_;
};

}  // namespace pilothouse::bench
