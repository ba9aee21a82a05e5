#pragma once

#include <pilothouse/SpeedLimit.h>
#include <pilothouse/StopState.h>

#include <optional>
#include <string>

#include "core/motion/motion_executor.hpp"

namespace pilothouse {

/// What keeps the robot from going on, from what limiter and gate report.
class ExecutorHolds {
 public:
  void take(const SpeedLimit& limit, double arrival);
  void take(const StopState& state, double arrival);
  /// @param now steady clock, as the arrivals [s]
  Hold at(double now, std::string& reason) const;
  /// Where the thing is that holds the robot, base frame [m]; nothing: unknown.
  std::optional<Eigen::Vector2d> place() const { return place_; }

 private:
  bool held_ = false, remembered_ = false, stopped_ = false;
  std::optional<Eigen::Vector2d> place_;
  std::string limit_text_, stop_text_;
  double limit_arrival_ = -1e9, stop_arrival_ = -1e9;
};

}  // namespace pilothouse
