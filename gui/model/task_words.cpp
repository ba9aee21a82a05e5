#include "gui/model/task_words.hpp"

#include <cmath>
#include <cstdio>

#include "gui/model/goal_aim.hpp"

namespace pilothouse::gui {

namespace {

constexpr double kSilent = 2.0;  // s; the navigator says something four times a second

struct Stage {
  Severity severity;
  const char* state;
};

Stage stageOf(NavigationPhase phase) {
  switch (phase) {
    case NavigationPhase::kPlanning:
      return {Severity::kNote, "Planning"};
    case NavigationPhase::kWaiting:
      return {Severity::kWarning, "Waiting"};
    case NavigationPhase::kLooking:
      return {Severity::kWarning, "Looking round"};
    case NavigationPhase::kBacking:
      return {Severity::kWarning, "Backing off"};
    case NavigationPhase::kPausing:
      return {Severity::kNote, "At its point"};
    default:
      return {Severity::kGood, "Running"};
  }
}

std::string placeWords(const NavigationReading& navigation) {
  char text[48];
  std::snprintf(text, sizeof text, "%.1f, %.1f", navigation.goal.x(), navigation.goal.y());
  return text;
}

std::string headlineOf(const TaskSituation& s) {
  const NavigationReading& n = s.navigation;
  if (s.task.behaviour == "hand") return "driven by hand";
  if (s.navigation_state.ever && n.points > 1) {
    return "to point " + std::to_string(n.point + 1) + " of " + std::to_string(n.points);
  }
  if (s.navigation_state.ever && n.points == 1) return "to " + placeWords(n);
  return s.task.behaviour;
}

std::string leftOf(const NavigationReading& navigation) {
  if (std::isnan(navigation.distance_left)) return {};
  std::string left = lengthWords(navigation.distance_left);
  if (!std::isnan(navigation.time_left)) left += ", " + timeWords(navigation.time_left);
  return left + " left";
}

TaskWords runningWords(const TaskSituation& s) {
  TaskWords words;
  const Stage stage = stageOf(s.navigation.phase);
  words.severity = stage.severity;
  words.state = stage.state;
  words.headline = headlineOf(s);
  const bool by_hand = s.task.behaviour == "hand";
  if (by_hand) {
    words.severity = Severity::kNote;
    words.state = "By hand";
    if (!s.task.waiting.empty()) words.why = s.task.waiting.front() + " waits until you let go";
    return words;
  }
  // Of a route the task's own words say no more than the headline.
  words.why = s.navigation.text;
  if (words.why.empty() && s.navigation.points < 2) words.why = s.task.text;
  if (s.gate_stopped) {
    words.severity = Severity::kWarning;
    words.state = "Waiting";
    if (words.why.empty()) words.why = "the stop gate holds the robot until it is armed";
  }
  words.left = leftOf(s.navigation);
  words.can_pause = words.can_cancel = true;
  words.can_skip = s.navigation.points > 1;
  return words;
}

TaskWords endedWords(const TaskSituation& s, Severity severity, const char* state) {
  TaskWords words;
  words.severity = severity;
  words.state = state;
  words.headline = headlineOf(s);
  words.why = !s.task.text.empty() ? s.task.text : s.navigation.text;
  return words;
}

TaskWords phaseWords(const TaskSituation& s) {
  switch (s.task.phase) {
    case TaskPhase::kRunning:
      return runningWords(s);
    case TaskPhase::kPaused: {
      TaskWords words = runningWords(s);
      words.severity = Severity::kWarning;
      words.state = "Paused";
      words.why = "by you; F5 goes on";
      words.can_pause = false;
      words.can_resume = words.can_cancel = true;
      return words;
    }
    case TaskPhase::kDone:
      return endedWords(s, Severity::kGood, "Done");
    case TaskPhase::kCancelled:
      return endedWords(s, Severity::kNote, "Cancelled");
    case TaskPhase::kFailed:
      return endedWords(s, Severity::kError, "Failed");
    case TaskPhase::kIdle:
      break;
  }
  TaskWords words;
  words.state = "Idle";
  words.headline = "no task: G aims at a goal, R edits a route";
  return words;
}

}  // namespace

TaskWords taskWords(const TaskSituation& s) {
  TaskWords words;
  if (!s.task_state.ever) {
    words.state = "No navigator";
    words.headline = "nobody publishes task_state";
    return words;
  }
  if (!s.task_state.rejection.empty()) {
    words.severity = Severity::kError;
    words.state = "Unreadable";
    words.headline = "task_state was refused";
    words.why = s.task_state.rejection;
    return words;
  }
  words = phaseWords(s);
  if (s.task_state.age_s > kSilent) {
    words.severity = Severity::kError;
    words.state = "Silent";
    words.why = "the navigator has said nothing for " + timeWords(s.task_state.age_s);
    words.left.clear();
  }
  const std::string refused = !s.refused.empty() ? s.refused : s.task.refused;
  if (!refused.empty()) {
    words.severity = Severity::kError;
    words.why = "refused: " + refused;
  }
  return words;
}

}  // namespace pilothouse::gui
