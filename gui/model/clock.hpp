#pragma once

#include "doors/steady_clock.hpp"

namespace pilothouse::gui {

/// Seconds of the steady clock: ages and rates are measured with it, so that a looping bag or a
/// corrected wall clock never disturbs them.
inline double steadySeconds() {
  return steadyNow();
}

}  // namespace pilothouse::gui
