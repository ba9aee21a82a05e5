#pragma once

#include <optional>
#include <string>

#include "gui/model/drive_readings.hpp"
#include "gui/model/feed_meter.hpp"
#include "gui/model/place_readings.hpp"
#include "gui/model/situation.hpp"

namespace pilothouse::gui {

/// All that the words about the task are made from.
struct TaskSituation {
  FeedState task_state, navigation_state;
  TaskReading task;              ///< meaningful when task_state.ever
  NavigationReading navigation;  ///< meaningful when navigation_state.ever
  bool gate_stopped = false;     ///< the stop gate holds the robot now
  std::string refused;           ///< why the newest ask failed, while that is news
};

/// What the task bar says and which of its buttons do something.
struct TaskWords {
  Severity severity = Severity::kNote;
  std::string state;     ///< one word: Running, Paused, Waiting, Failed, ...
  std::string headline;  ///< "to point 2 of 5"
  std::string why;       ///< why it waits, failed or was refused; may be empty
  std::string left;      ///< "3.2 m, 11 s left"; empty: nothing is driven
  bool can_pause = false, can_resume = false, can_cancel = false, can_skip = false;
};

TaskWords taskWords(const TaskSituation& situation);

}  // namespace pilothouse::gui
