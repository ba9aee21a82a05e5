#include "sim/imu.hpp"

#include <algorithm>

namespace pilothouse::sim {
namespace {

using Eigen::Vector3d;

constexpr double kGravity = 9.81;  // [m/s^2]

Vector3d normal(Random& random) {
  const double x = random.normal(), y = random.normal();
  return {x, y, random.normal()};
}

}  // namespace

Imu::Imu(const ImuNoise& noise, std::uint64_t seed)
    : noise_(noise),
      random_(seed),
      rate_bias_(noise.rate_bias * normal(random_)),
      acceleration_bias_(noise.acceleration_bias * normal(random_)) {}

void Imu::step(const Eigen::Isometry3d& T_world_base, double dt) {
  Vector3d rate = Vector3d::Zero(), acceleration = Vector3d::Zero();
  const Vector3d velocity = (T_world_base.translation() - T_world_before_.translation()) / dt;
  if (steps_ >= 1) {
    const Eigen::AngleAxisd turn(T_world_before_.linear().transpose() * T_world_base.linear());
    rate = turn.angle() / dt * turn.axis();
  }
  if (steps_ >= 2) acceleration = (velocity - velocity_) / dt;
  const Vector3d felt =
      T_world_base.linear().transpose() * (acceleration + kGravity * Vector3d::UnitZ());
  reading_ = {noisy(rate, rate_bias_, noise_.rate),
              noisy(felt, acceleration_bias_, noise_.acceleration)};
  velocity_ = velocity;
  T_world_before_ = T_world_base;
  steps_ = std::min(steps_ + 1, 2);
}

Vector3d Imu::noisy(const Vector3d& value, const Vector3d& bias, double spread) {
  return value + bias + spread * normal(random_);
}

}  // namespace pilothouse::sim
