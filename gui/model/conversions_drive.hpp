#pragma once

#include <geometry_msgs/TwistStamped.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/Range.h>

#include <vector>

#include <pilothouse/Contacts.h>
#include "core/cloud/checked.hpp"
#include "gui/model/drive_readings.hpp"
#include "pilothouse/RouteState.h"
#include "pilothouse/SpeedLimit.h"
#include "pilothouse/StopState.h"

namespace pilothouse::gui {

// Messages of the driving side into readings. Nothing in a message is trusted: what is out of range
// is refused with the reason.

/// Printable characters only, at most `most` of them: for texts that others wrote.
std::string plainText(const std::string& text, std::size_t most = 160);

Checked<LimitReading> limitFromMessage(const SpeedLimit& limit);
Checked<StopReading> stopFromMessage(const StopState& stop);
/// Those joints whose name ends in _wheel.
Checked<std::vector<WheelReading>> wheelsFromMessage(const sensor_msgs::JointState& joints);
Checked<RangeReading> rangeFromMessage(const sensor_msgs::Range& range);
Checked<ContactsReading> contactsFromMessage(const Contacts& contacts);
Checked<RouteReading> routeFromMessage(const RouteState& route);
Checked<WantedReading> wantedFromMessage(const geometry_msgs::TwistStamped& twist);

}  // namespace pilothouse::gui
