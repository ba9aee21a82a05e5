#pragma once

#include <diagnostic_msgs/DiagnosticStatus.h>
#include <geometry_msgs/Twist.h>
#include <pilothouse/StopState.h>

#include <string>

#include "gate/gate_inbox.hpp"

namespace pilothouse {

/// What one step led to, in words too.
struct GateReport {
  GateOutput output;
  double ros = 0.0;  ///< time of the step [s]
  std::string text, obstacle;
};

GateReport reportOf(const GateOutput& output, double ros, const GateInbox::Names& consoles,
                    const ShortName& publisher);
geometry_msgs::Twist twistOf(const Twist2& command);
StopState stateOf(const GateReport& report);
diagnostic_msgs::DiagnosticStatus diagnosticOf(const GateReport& report);

}  // namespace pilothouse
