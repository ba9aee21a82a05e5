#include "gui/model/teleop.hpp"

#include <algorithm>
#include <cmath>

namespace pilothouse::gui {

namespace {

unsigned long codeOf(KeyMeaning key) {
  return static_cast<unsigned long>(key.meaning) * 4UL + key.variant;
}

double bounded(double value) {
  return std::isfinite(value) ? std::clamp(value, -1.0, 1.0) : 0.0;
}

}  // namespace

void Teleop::press(KeyMeaning key, double now) {
  keys_.press(codeOf(key), now);
}

void Teleop::pressElsewhere(KeyMeaning key, double now) {
  keys_.pressSpent(codeOf(key), now);
}

void Teleop::release(KeyMeaning key, double now) {
  keys_.release(codeOf(key), now);
}

void Teleop::stick(std::optional<Twist2> deflection) {
  if (deflection) {
    deflection = Twist2{bounded(deflection->vx), bounded(deflection->vy), bounded(deflection->w)};
  }
  stick_ = deflection;
}

void Teleop::setCap(double cap) {
  if (std::isfinite(cap)) cap_ = std::clamp(cap, 0.0, base_.max_speed);
}

void Teleop::interrupt(HandsOff reason) {
  keys_.spend();
  stick_.reset();
  reason_ = reason;
}

bool Teleop::held(DriveKey meaning, double now) const {
  for (unsigned variant = 0; variant < 2; ++variant) {
    if (keys_.held(codeOf({meaning, variant}), now)) return true;
  }
  return false;
}

bool Teleop::wanted(double now) const {
  if (stick_) return true;
  for (const auto meaning : {DriveKey::kForward, DriveKey::kBack, DriveKey::kTurnLeft,
                             DriveKey::kTurnRight, DriveKey::kSideLeft, DriveKey::kSideRight}) {
    const bool sideways = meaning == DriveKey::kSideLeft || meaning == DriveKey::kSideRight;
    if (sideways && base_.kind == BaseKind::kDifferential) continue;
    if (held(meaning, now)) return true;
  }
  return false;
}

Twist2 Teleop::wish(double now) const {
  const auto axis = [&](DriveKey plus, DriveKey minus) {
    return (held(plus, now) ? 1.0 : 0.0) - (held(minus, now) ? 1.0 : 0.0);
  };
  Twist2 share{axis(DriveKey::kForward, DriveKey::kBack),
               axis(DriveKey::kSideLeft, DriveKey::kSideRight),
               axis(DriveKey::kTurnLeft, DriveKey::kTurnRight)};
  if (stick_ && share.zero()) share = *stick_;
  if (base_.kind == BaseKind::kDifferential) share.vy = 0.0;
  const double length = share.linear();
  if (length > 1.0) share = {share.vx / length, share.vy / length, share.w};
  const double slow = held(DriveKey::kSlow, now) ? kSlowFactor : 1.0;
  const double speed = cap_ * slow;
  const double turn = base_.max_speed > 0.0 ? base_.max_turn_rate * speed / base_.max_speed : 0.0;
  return {share.vx * speed, share.vy * speed, share.w * turn};
}

std::optional<Twist2> Teleop::comeToRest(double now, bool moves) {
  if (driving_) {
    let_go_at_ = now;
  } else if (!resting_ || now < next_) {
    return std::nullopt;
  } else if (!moves || now - let_go_at_ > kComesToRest) {
    resting_ = false;
    return std::nullopt;
  }
  driving_ = false;
  resting_ = true;
  next_ = now + kPeriod;
  command_ = {};
  return command_;
}

std::optional<Twist2> Teleop::step(double now, HandsOff hindrance, bool moves) {
  const bool wants = wanted(now);
  if (hindrance != HandsOff::kNone) {
    if (wants || driving_) interrupt(hindrance);
  }
  if (!wants || hindrance != HandsOff::kNone) return comeToRest(now, moves);
  if (driving_ && now < next_) return std::nullopt;
  // In step with its own beat, except after a pause.
  next_ = driving_ && now - next_ < kPeriod ? next_ + kPeriod : now + kPeriod;
  driving_ = true;
  resting_ = false;
  reason_ = HandsOff::kNone;
  command_ = wish(now);
  return command_;
}

}  // namespace pilothouse::gui
