#pragma once

#include <Eigen/Geometry>
#include <cstdint>

#include "sim/random.hpp"

namespace pilothouse::sim {

struct ImuNoise {
  double rate = 0.003;              ///< spread of a reading [rad/s]
  double rate_bias = 0.002;         ///< spread of the constant error of each axis [rad/s]
  double acceleration = 0.03;       ///< [m/s^2]
  double acceleration_bias = 0.02;  ///< [m/s^2]
};

struct ImuReading {
  Eigen::Vector3d rate = Eigen::Vector3d::Zero();          ///< base frame [rad/s]
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();  ///< with gravity, base frame [m/s^2]
};

/// Gyroscopes and accelerometers in the middle of the base.
class Imu {
 public:
  Imu(const ImuNoise& noise, std::uint64_t seed);
  /// The robot has moved to `T_world_base` within `dt` [s].
  void step(const Eigen::Isometry3d& T_world_base, double dt);
  /// It was put somewhere else: no motion.
  void restart() { steps_ = 0; }
  const ImuReading& reading() const { return reading_; }

 private:
  Eigen::Vector3d noisy(const Eigen::Vector3d& value, const Eigen::Vector3d& bias, double spread);

  ImuNoise noise_;
  Random random_;
  Eigen::Vector3d rate_bias_, acceleration_bias_;
  int steps_ = 0;  ///< since the restart, up to 2
  Eigen::Isometry3d T_world_before_ = Eigen::Isometry3d::Identity();
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();
  ImuReading reading_;
};

}  // namespace pilothouse::sim
