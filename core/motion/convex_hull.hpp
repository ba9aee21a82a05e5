#pragma once

#include <Eigen/Core>
#include <vector>

namespace pilothouse {

/// Convex hull of any points, counter-clockwise, without corners on a straight edge (Andrew's
/// monotone chain, 1979); fewer than three corners where the points lie on one line.
std::vector<Eigen::Vector2d> convexHull(std::vector<Eigen::Vector2d> points);

}  // namespace pilothouse
