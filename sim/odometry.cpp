#include "sim/odometry.hpp"

namespace pilothouse::sim {

Odometry::Odometry(const BaseParameters& base, const OdometryNoise& noise, std::uint64_t seed)
    : kinematics_(base), noise_(noise), random_(seed) {
  for (double& scale : scales_) scale = 1.0 + noise_.radius * random_.normal();
}

void Odometry::step(const WheelStates& wheels, double dt) {
  WheelStates seen = wheels;
  for (std::size_t i = 0; i < kinematics_.wheels().size(); ++i) {
    // The numbers are drawn in any case, so that a stop does not change what follows. Encoders of
    // wheels that stand say so.
    const double error = noise_.speed * random_.normal();
    if (wheels[i].speed != 0.0) seen[i].speed = scales_[i] * wheels[i].speed + error;
  }
  reading_.twist = kinematics_.forward(seen).twist;
  reading_.pose = advanced(reading_.pose, reading_.twist, dt);
}

}  // namespace pilothouse::sim
