#include "sim/wheel_drive.hpp"

#include <algorithm>
#include <cmath>

namespace pilothouse::sim {
namespace {

constexpr double kStanding = 1e-5;  ///< a lagging wheel this slow stands [m/s]
/// Part of the acceleration that is left while wheels point across: without any, nothing would say
/// where they shall point.
constexpr double kCreep = 0.02;
constexpr double kTolerance = 1e-9;  ///< [s]

}  // namespace

void WheelDrive::command(const Twist2& twist, double now) {
  if (!twist.finite()) return;
  wanted_ = withinLimits(twist, base_);
  commanded_at_ = now;
  commanded_ = true;
}

void WheelDrive::step(double now, double dt) {
  if (now - commanded_at_ > base_.command_timeout + kTolerance) commanded_ = false;
  approach(commanded_ ? wanted_ : Twist2{}, dt);
  const WheelStates wanted = kinematics_.inverse(set_, wheels_);
  if (kinematics_.steered()) steer(wanted, dt);
  alignment_ = kinematics_.alignment(wheels_, wanted);
  const double share = base_.lag > 0.0 ? 1.0 - std::exp(-dt / base_.lag) : 1.0;
  for (std::size_t i = 0; i < kinematics_.wheels().size(); ++i) {
    double& speed = wheels_[i].speed;
    speed += share * (alignment_ * wanted[i].speed - speed);
    if (wanted[i].speed == 0.0 && std::abs(speed) < kStanding) speed = 0.0;
  }
}

void WheelDrive::block() {
  set_ = {};
  for (auto& wheel : wheels_) wheel.speed = 0.0;
}

void WheelDrive::approach(const Twist2& target, double dt) {
  const Twist2 change = target - set_;
  const bool slowing = change.vx * set_.vx + change.vy * set_.vy < 0.0;
  const bool turning_less = change.w * set_.w < 0.0;
  // Speeding up waits for wheels that still turn; braking waits for nothing.
  const double share = std::max(kCreep, alignment_);
  const double linear = slowing ? base_.deceleration : share * base_.acceleration;
  const double turn = (slowing || turning_less ? 1.0 : share) * base_.turn_acceleration;
  const double steps = std::max(change.linear() / (linear * dt), std::abs(change.w) / (turn * dt));
  set_ = steps <= 1.0 ? target : set_ + (1.0 / steps) * change;
}

void WheelDrive::steer(const WheelStates& wanted, double dt) {
  const double most = base_.steering_rate * dt;
  for (std::size_t i = 0; i < kinematics_.wheels().size(); ++i) {
    const double error = wrapped(wanted[i].angle - wheels_[i].angle);
    wheels_[i].angle = wrapped(wheels_[i].angle + std::clamp(error, -most, most));
  }
}

}  // namespace pilothouse::sim
