#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "gui/model/drive_readings.hpp"
#include "gui/model/feed.hpp"
#include "gui/model/guarded.hpp"
#include "gui/model/pictures.hpp"
#include "gui/model/place_state.hpp"
#include "gui/model/robot_clock.hpp"
#include "gui/model/situation.hpp"
#include "gui/model/telemetry.hpp"

namespace pilothouse::gui {

/// Where the camera stands on the robot by tf: in the base frame [m, rad].
struct CameraPose {
  double x, y, yaw;
};

/// How the floor nodelet judges, as it last announced.
struct FloorSettings {
  bool known = false;  ///< the nodelet has announced its parameters
  bool original = false;
  bool calibrate = false;
  std::string fault;  ///< why the last wish was not granted; empty: it was
};

/// Something that was refused, and when (steady [s]).
struct Refusal {
  std::string reason;
  double at = -1e9;
};

/// How the newest arming goes. Times are steady seconds.
struct ArmingState {
  double asked_at = kUnknown;  ///< of the one that is under way; NaN: none is
  Refusal refused;             ///< of the last one that failed
};

/// All that the console shows, between the ROS side that fills it and the panels that read it.
/// Knows neither ROS nor widgets.
struct ConsoleState {
  Feed<DepthPicture> depth;
  Feed<ColourPicture> colour;
  Feed<FloorPicture> floor;
  Feed<ObjectsPicture> objects;
  Feed<LimitReading> limit;
  Feed<StopReading> gate;
  Telemetry telemetry;
  Guarded<std::map<std::string, RangeReading>> ranges;   ///< by the ranger's name
  Guarded<std::map<std::string, WantedReading>> wanted;  ///< by its source: teleop, task
  Guarded<ContactsReading> contacts;
  Guarded<RouteReading> route;
  PlaceState place;
  Guarded<ArmingState> arming;
  Guarded<std::map<std::string, Refusal>> refusals;  ///< by topic
  RobotClock clock;
  Guarded<LinkStatus> link;
  Guarded<std::set<std::string>> advertised;          ///< resolved names of topics with a publisher
  Guarded<std::map<std::string, std::string>> names;  ///< relative topic -> resolved
  Guarded<std::vector<Complaint>> complaints;
  Guarded<std::string> missing_transform;
  Guarded<std::optional<CameraPose>> camera_pose;
  Guarded<FloorSettings> floor_settings;
};

/// A topic as the status and the empty panels name it: resolved where the link knows it.
std::string shownTopic(const ConsoleState& state, const std::string& relative);
/// Snapshot of everything that the status sentence is made from.
Situation situationOf(const ConsoleState& state, const std::string& robot, double now);

}  // namespace pilothouse::gui
