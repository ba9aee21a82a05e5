#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/motion/footprint.hpp"
#include "core/motion/planar.hpp"

namespace pilothouse::gui {

/// What the footprint covers when the base holds a twist, for drawing; base frame [m].
struct SweptOutline {
  std::vector<std::vector<Eigen::Vector2d>> outlines;  ///< the footprint, step by step
  std::vector<Eigen::Vector2d> left, right;            ///< what the outermost corners run along
};

/// @param way of the footprint's fastest point that is drawn [m]; never more than half a turn.
SweptOutline sweptOutline(const Footprint& footprint, const Twist2& twist, double way);

/// The footprint after that way [m].
std::vector<Eigen::Vector2d> footprintAfter(const Footprint& footprint, const Twist2& twist,
                                            double way);

}  // namespace pilothouse::gui
