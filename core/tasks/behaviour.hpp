#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "core/navigation/goal_navigator.hpp"

namespace pilothouse {

/// A place that a route passes.
struct RouteStop {
  Goal goal;
  double pause = 0.0;  ///< it stands there so long [s]
};

/// What somebody wants the robot to be at.
struct Wish {
  std::string behaviour;         ///< by name
  std::vector<RouteStop> stops;  ///< of go_to: one
  bool loop = false;             ///< after the last stop the first again
};

/// What a behaviour is told in each step.
struct TaskInput {
  NavigationInput navigation;
  bool hand = false;  ///< a person drives right now
};

struct BehaviourReport {
  enum State { kRunning, kDone, kFailed };
  State state = kRunning;
  std::string text;  ///< what it does; why it failed
  NavigationStatus navigation;
  std::size_t point = 0, points = 0;  ///< of a route
  std::optional<DriveOrder> order;    ///< new in this step
};

/// Something that the robot can be at, one at a time, under the tasker.
class Behaviour {
 public:
  virtual ~Behaviour() = default;
  virtual BehaviourReport step(const TaskInput& input) = 0;
  /// It goes on after it was set aside; where the robot was taken to in between is unknown.
  virtual void resume() {}
  /// On to the next part. @return why not; empty: done.
  virtual std::string skip() { return "it has no parts to skip"; }
};

/// What behaviours work with.
struct BehaviourTools {
  Planner& planner;  ///< outlives them
  NavigationParameters navigation;
};

/// A kind of behaviour; core/tasks/behaviours.cpp lists them all.
struct BehaviourKind {
  const char* name;
  int priority;  ///< higher ones set lower ones aside
  bool asked;    ///< paused, resumed, skipped and cancelled by a person; else it ends by itself
  /// Why a wish cannot be granted; empty: it can.
  std::string (*faultOf)(const Wish& wish);
  std::unique_ptr<Behaviour> (*make)(const Wish& wish, const BehaviourTools& tools);
};

const std::vector<BehaviourKind>& behaviourKinds();

// Each in a file of its own.
extern const BehaviourKind kDriveByHand;
extern const BehaviourKind kGoTo;
extern const BehaviourKind kFollowRoute;

}  // namespace pilothouse
