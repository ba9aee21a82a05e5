#pragma once

#include <string>

#include "gui/model/console_state.hpp"

namespace pilothouse::gui {

/// Calls the floor nodelet's set_parameters and waits for its answer, which comes in
/// floor_settings; for a thread that may wait.
void setFloor(ConsoleState& state, const std::string& method, bool calibrate);

}  // namespace pilothouse::gui
