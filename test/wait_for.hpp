#pragma once

#include <chrono>
#include <functional>
#include <thread>

#include "gui/model/clock.hpp"

namespace pilothouse::gui {

/// Waits for what other threads bring about, far longer than anything here takes.
/// @return whether it came.
inline bool waitFor(const std::function<bool()>& condition) {
  constexpr double kPatience = 60.0;  // [s]
  const double until = steadySeconds() + kPatience;
  while (steadySeconds() < until) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return condition();
}

}  // namespace pilothouse::gui
