#include "nodelets/executor_holds.hpp"

#include <cmath>
#include <cstdio>

namespace pilothouse {
namespace {

constexpr float kNothing = 0.01F;  // slower than this is standing [m/s]
constexpr double kFresh = 1.0;     // older reports hold nobody: their senders are gone [s]

std::string textOf(const SpeedLimit& limit) {
  switch (limit.cause) {
    case SpeedLimit::STALE:
      return limit.sensor + " is silent";
    case SpeedLimit::UNSEEN:
      return "nothing has looked at where the route goes";
    case SpeedLimit::BAD_COMMAND:
      return "the command is not finite";
    default:
      break;
  }
  char distance[32] = "";
  if (std::isfinite(limit.distance)) {
    std::snprintf(distance, sizeof distance, " at %.2f m", static_cast<double>(limit.distance));
  }
  return (limit.sensor == "memory" ? "something remembered" : "seen by " + limit.sensor) + distance;
}

}  // namespace

void ExecutorHolds::take(const SpeedLimit& limit, double arrival) {
  limit_arrival_ = arrival;
  held_ = limit.wanted > kNothing && !(limit.limit > kNothing);
  remembered_ = held_ && limit.sensor == "memory";
  if (held_) limit_text_ = "held: " + textOf(limit);
  place_.reset();
  if (held_ && std::isfinite(limit.position.x) && std::isfinite(limit.position.y)) {
    place_ = Eigen::Vector2d(static_cast<double>(limit.position.x),
                             static_cast<double>(limit.position.y));
  }
}

void ExecutorHolds::take(const StopState& state, double arrival) {
  stop_arrival_ = arrival;
  stopped_ = state.state == StopState::STOPPED;
  if (stopped_) stop_text_ = "stop gate: " + state.text;
}

Hold ExecutorHolds::at(double now, std::string& reason) const {
  if (stopped_ && now - stop_arrival_ < kFresh) {
    reason = stop_text_;
    return Hold::kStopped;
  }
  if (!held_ || now - limit_arrival_ > kFresh) return Hold::kNone;
  reason = limit_text_;
  return remembered_ ? Hold::kRemembered : Hold::kSeen;
}

}  // namespace pilothouse
