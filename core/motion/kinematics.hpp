#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "core/motion/base_parameters.hpp"
#include "core/motion/planar.hpp"

namespace pilothouse {

/// A wheel where it touches the floor.
struct Wheel {
  std::string name;          ///< e.g. front_left
  Eigen::Vector2d position;  ///< base frame [m]
};

struct WheelState {
  double angle = 0.0;  ///< from the base's x to where it rolls, counter-clockwise [rad], -pi..pi;
                       ///< 0 of a wheel that is not steered
  double speed = 0.0;  ///< of its rim, positive along that angle [m/s]
};

/// One a wheel, in the order of Kinematics::wheels(); a differential base uses the first two.
using WheelStates = std::array<WheelState, 4>;

/// How a base moves by its wheels.
struct WheelMotion {
  Twist2 twist;
  double slip = 0.0;  ///< root mean square of what the wheels would have to slip [m/s]
};

/// Wheels to twist and back for the three bases: each wheel's contact point moves as the rigid base
/// does (Siegwart, Nourbakhsh and Scaramuzza 2011, "Introduction to Autonomous Mobile
/// Robots", 3.2); mecanum wheels have rollers at 45 degrees that form an X seen from above.
class Kinematics {
 public:
  /// @param base sound by validate().
  explicit Kinematics(const BaseParameters& base);

  const std::vector<Wheel>& wheels() const { return wheels_; }
  bool steered() const { return kind_ == BaseKind::kFourWheelSteered; }
  bool sideways() const { return kind_ != BaseKind::kDifferential; }

  /// What the wheels must do for `twist`. A steered wheel takes, of the two angles that serve, the
  /// one nearer to its present angle, and keeps that where it need not move. A twist that is not
  /// finite gives zero speeds; the sideways part of a differential base's is ignored.
  /// @param now the wheels' present states.
  WheelStates inverse(const Twist2& twist, const WheelStates& now) const;

  /// How far the drives may turn while the steering is on its way from `now` to `wanted`, 0..1: the
  /// cosine of the largest steering error. One factor for all wheels keeps the path's shape.
  double alignment(const WheelStates& now, const WheelStates& wanted) const;

  /// The twist that fits the wheels best in the sense of least squares.
  WheelMotion forward(const WheelStates& states) const;

 private:
  WheelMotion forwardSteered(const WheelStates& states) const;

  BaseKind kind_;
  std::vector<Wheel> wheels_;
  /// Speeds of wheels that are not steered = rows_ (vx, vy, w), and its pseudo-inverse.
  Eigen::Matrix<double, 4, 3> rows_ = Eigen::Matrix<double, 4, 3>::Zero();
  Eigen::Matrix<double, 3, 4> inverse_rows_ = Eigen::Matrix<double, 3, 4>::Zero();
};

/// The twist scaled, all of it by one factor so that the path keeps its shape, until neither the
/// base's speed nor its turn rate is too high. A differential base cannot move sideways: that part
/// is dropped first. A twist that is not finite becomes zero.
Twist2 withinLimits(const Twist2& twist, const BaseParameters& base);

}  // namespace pilothouse
