#pragma once

#include <string>

namespace pilothouse::gui {

// Questions to the ROS master that never wait for one; only for the link thread.

/// What tells one master from the next: its process and the id of its run. Empty: no answer.
std::string masterIdentity();
/// A text parameter by its resolved name; empty when it is not there or no text.
std::string masterText(const std::string& name);
/// A true or false parameter; false when it is not there.
bool masterFlag(const std::string& name);

}  // namespace pilothouse::gui
