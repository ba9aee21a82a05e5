#pragma once

#include <Eigen/Geometry>
#include <cmath>

namespace pilothouse {

/// Velocity of the base in its own frame (x forward, y left).
struct Twist2 {
  double vx = 0.0;  ///< [m/s]
  double vy = 0.0;  ///< [m/s]
  double w = 0.0;   ///< counter-clockwise [rad/s]

  bool finite() const { return std::isfinite(vx) && std::isfinite(vy) && std::isfinite(w); }
  bool zero() const { return vx == 0.0 && vy == 0.0 && w == 0.0; }
  double linear() const { return std::hypot(vx, vy); }
};

inline Twist2 operator*(double scale, const Twist2& t) {
  return {scale * t.vx, scale * t.vy, scale * t.w};
}
inline Twist2 operator+(const Twist2& a, const Twist2& b) {
  return {a.vx + b.vx, a.vy + b.vy, a.w + b.w};
}
inline Twist2 operator-(const Twist2& a, const Twist2& b) {
  return {a.vx - b.vx, a.vy - b.vy, a.w - b.w};
}

/// An angle brought to [-pi, pi).
inline double wrapped(double angle) {
  constexpr double kTurn = 6.283185307179586;
  return angle - kTurn * std::floor((angle + 0.5 * kTurn) / kTurn);
}

/// Pose of the base in a frame that is fixed to the floor (odom or a world).
struct Pose2 {
  double x = 0.0, y = 0.0;  ///< [m]
  double heading = 0.0;     ///< of the base's x, counter-clockwise [rad]

  Eigen::Vector2d position() const { return {x, y}; }
  /// A point of the base frame in the fixed one.
  Eigen::Vector2d operator*(const Eigen::Vector2d& p) const {
    const double c = std::cos(heading), s = std::sin(heading);
    return {x + c * p.x() - s * p.y(), y + s * p.x() + c * p.y()};
  }
  /// A point of the fixed frame in the base's.
  Eigen::Vector2d toBase(const Eigen::Vector2d& p) const {
    const double c = std::cos(heading), s = std::sin(heading);
    const double dx = p.x() - x, dy = p.y() - y;
    return {c * dx + s * dy, c * dy - s * dx};
  }
  bool finite() const { return std::isfinite(x) && std::isfinite(y) && std::isfinite(heading); }
};

/// The pose after driving `twist` for `dt` [s], along the exact arc.
inline Pose2 advanced(const Pose2& pose, const Twist2& twist, double dt) {
  const double turn = twist.w * dt;
  // sin(t)/t and (1-cos(t))/t, by their series where t is small.
  const double a = std::abs(turn) < 1e-4 ? 1.0 - turn * turn / 6.0 : std::sin(turn) / turn;
  const double b = std::abs(turn) < 1e-4 ? 0.5 * turn : (1.0 - std::cos(turn)) / turn;
  const Eigen::Vector2d along{(a * twist.vx - b * twist.vy) * dt,
                              (b * twist.vx + a * twist.vy) * dt};
  const Eigen::Vector2d end = pose * along;
  return {end.x(), end.y(), wrapped(pose.heading + turn)};
}

}  // namespace pilothouse
