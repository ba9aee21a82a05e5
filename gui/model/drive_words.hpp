#pragma once

#include <string>

#include "gui/model/drive_readings.hpp"
#include "gui/model/feed_meter.hpp"
#include "gui/model/helm.hpp"
#include "gui/model/situation.hpp"

namespace pilothouse::gui {

/// All that the sentence about driving is made from.
struct DriveSituation {
  bool connected = false;  ///< to a master
  FeedState limit_state, stop_state;
  LimitReading limit;  ///< meaningful when limit_state.ever
  StopReading stop;    ///< meaningful when stop_state.ever
  HelmView helm;
  ContactsReading contacts;
  std::string arming_refused;    ///< why the last arming failed, while that is news
  double arming_for = kUnknown;  ///< since what is under way was asked for [s]; NaN: nothing is
  double now = 0.0;              ///< steady [s]
};

/// A sentence for the operator and what to do about it (may be empty).
struct DriveWords {
  Severity severity = Severity::kNote;
  std::string headline, advice;
};

/// What moves or holds the robot, in words; always something.
DriveWords driveWords(const DriveSituation& situation);

/// "Slowed to 0.18 m/s: front ranger sees something 0.62 m ahead"
std::string limitWords(const LimitReading& limit);
/// "route: to point 2 of 5, 3.1 m left"; empty where there is nothing to tell.
std::string routeWords(const RouteReading& route);
/// "Stopped: camera silent for 0.4 s"
std::string stopWords(const StopReading& stop);

}  // namespace pilothouse::gui
