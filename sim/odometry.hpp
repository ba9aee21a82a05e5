#pragma once

#include <cstdint>

#include "core/motion/kinematics.hpp"
#include "sim/random.hpp"

namespace pilothouse::sim {

struct OdometryNoise {
  double radius = 0.0005;  ///< spread of the share by which each wheel is thicker than it seems
  double speed = 0.002;    ///< spread of each reading of a wheel's speed [m/s]
};

struct OdometryReading {
  Pose2 pose;    ///< in frame odom, which is where the robot stood at the start
  Twist2 twist;  ///< base frame
};

/// Counts the way by the wheels, and knows nothing of slip. Over a way of D metres it drifts by a
/// few percent of D.
class Odometry {
 public:
  Odometry(const BaseParameters& base, const OdometryNoise& noise, std::uint64_t seed);
  /// Adds `dt` [s] during which the wheels were as given.
  void step(const WheelStates& wheels, double dt);
  const OdometryReading& reading() const { return reading_; }

 private:
  Kinematics kinematics_;
  OdometryNoise noise_;
  Random random_;
  std::array<double, 4> scales_;
  OdometryReading reading_;
};

}  // namespace pilothouse::sim
