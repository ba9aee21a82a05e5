#pragma once

#include <chrono>

namespace pilothouse::gui {

/// Seconds of the steady clock: ages and rates are measured with it, so that a looping bag or a
/// corrected wall clock never disturbs them.
inline double steadySeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace pilothouse::gui
