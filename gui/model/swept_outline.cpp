#include "gui/model/swept_outline.hpp"

#include <algorithm>
#include <cmath>

#include "core/motion/swept_path.hpp"

namespace pilothouse::gui {

namespace {

constexpr double kStep = 0.06;     // m between outlines
constexpr double kMostTurn = 1.2;  // rad, as far as the limiter looks along an arc
constexpr double kStands = 1e-4;   // m/s, rad/s

Pose2 poseAfter(const Footprint& footprint, const Twist2& twist, double way) {
  const double speed = SweptPath::speedOf(footprint, twist);
  double time = speed > kStands ? way / speed : 0.0;
  if (std::abs(twist.w) * time > kMostTurn) time = kMostTurn / std::abs(twist.w);
  return advanced(Pose2(), twist, time);
}

// How far a corner lies to the left of the way of the base's origin.
double leftOf(const Eigen::Vector2d& corner, const Twist2& twist) {
  if (std::abs(twist.w) < 1e-3) {
    return (twist.vx * corner.y() - twist.vy * corner.x()) / std::max(kStands, twist.linear());
  }
  const Eigen::Vector2d centre(-twist.vy / twist.w, twist.vx / twist.w);
  return -std::copysign((corner - centre).norm(), twist.w);
}

}  // namespace

std::vector<Eigen::Vector2d> footprintAfter(const Footprint& footprint, const Twist2& twist,
                                            double way) {
  const Pose2 pose = poseAfter(footprint, twist, way);
  std::vector<Eigen::Vector2d> outline;
  for (const auto& corner : footprint.corners()) outline.push_back(pose * corner);
  return outline;
}

SweptOutline sweptOutline(const Footprint& footprint, const Twist2& twist, double way) {
  SweptOutline swept;
  if (!twist.finite() || !(way > 0.0) || SweptPath::speedOf(footprint, twist) <= kStands) {
    return swept;
  }
  const auto& corners = footprint.corners();
  // Of corners as far aside, the one that leads: its way ends where the area does.
  const auto outermost = [&](double side) {
    const auto reach = [&](const Eigen::Vector2d& p) {
      return side * leftOf(p, twist) +
             0.02 * (p.x() * twist.vx + p.y() * twist.vy) / std::max(kStands, twist.linear());
    };
    return *std::max_element(
        corners.begin(), corners.end(),
        [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return reach(a) < reach(b); });
  };
  const Eigen::Vector2d left = outermost(1.0);
  const Eigen::Vector2d right = outermost(-1.0);
  const int steps = std::clamp(static_cast<int>(std::ceil(way / kStep)), 1, 120);
  for (int i = 0; i <= steps; ++i) {
    const Pose2 pose = poseAfter(footprint, twist, way * i / steps);
    std::vector<Eigen::Vector2d> outline;
    for (const auto& corner : corners) outline.push_back(pose * corner);
    swept.outlines.push_back(std::move(outline));
    swept.left.push_back(pose * left);
    swept.right.push_back(pose * right);
  }
  return swept;
}

}  // namespace pilothouse::gui
