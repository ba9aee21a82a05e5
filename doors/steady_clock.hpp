#pragma once

#include <chrono>

namespace pilothouse {

/// Seconds of the clock that never jumps, for deadlines of safety.
inline double steadyNow() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace pilothouse
