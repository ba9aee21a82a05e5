#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>

#include "core/motion/footprint.hpp"
#include "core/motion/planar.hpp"

namespace pilothouse::sim {

/// What of a triangle lies between two heights, seen from above: convex; two corners where it
/// stands upright.
struct Slice {
  std::array<Eigen::Vector2d, 5> corners;
  std::size_t count = 0;
};

/// @param corners of the triangle; heights are along z [m].
/// @return nothing where the triangle lies outside, or only touches low or high.
std::optional<Slice> sliceOf(const std::array<Eigen::Vector3d, 3>& corners, double low,
                             double high);

/// How far the outline, driven to `pose` in the slice's frame, is from the slice [m]; negative: the
/// depth to which they overlap (the shortest way apart; separating axes, Gottschalk et al. 1996).
double separation(const Footprint& footprint, const Pose2& pose, const Slice& slice);

}  // namespace pilothouse::sim
