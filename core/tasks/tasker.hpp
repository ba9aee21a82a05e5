#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/cloud/checked.hpp"
#include "core/tasks/behaviour.hpp"

namespace pilothouse {

/// As in the message TaskState.
enum class TaskPhase {
  kIdle = 0,
  kRunning = 1,
  kPaused = 2,
  kDone = 3,
  kCancelled = 4,
  kFailed = 5
};

struct TaskReport {
  std::uint32_t id = 0;  ///< 0: there was none yet
  std::string behaviour;
  TaskPhase phase = TaskPhase::kIdle;
  std::string text;
};

struct TaskerOutput {
  TaskReport task;                   ///< the one that runs, or ended last
  std::vector<std::string> waiting;  ///< behaviours that were set aside, the next first
  BehaviourReport behaviour;         ///< of the step; of one that does not run, its last
  std::optional<DriveOrder> order;   ///< new in this step
  std::vector<TaskReport> ended;     ///< since the last step
};

/// One behaviour at a time. One of a higher priority sets the others aside until it has ended; one
/// of the same priority replaces the old; one of a lower waits. What a person paused stays so until
/// they resume it. Whenever the behaviour changes the executor is told to stop first.
class Tasker {
 public:
  explicit Tasker(const BehaviourTools& tools) : tools_(tools) {}

  /// @return the new task's id, or why there is none; then all is as before.
  Checked<std::uint32_t> submit(const Wish& wish);
  // Each returns why not; empty: done. Id 0: the task that runs, or that driving by hand sets
  // aside.
  std::string pause();
  std::string resume();
  std::string cancel(std::uint32_t id = 0);
  std::string skip();

  TaskerOutput step(const TaskInput& input);

 private:
  struct Task {
    std::uint32_t id = 0;
    const BehaviourKind* kind = nullptr;
    std::unique_ptr<Behaviour> behaviour;
    bool paused = false;  ///< by a person
    bool aside = false;   ///< it ran and another took its place
  };
  Task* current() { return tasks_.empty() ? nullptr : &tasks_.front(); }
  Task* asked();
  void end(std::size_t place, TaskPhase phase, const std::string& text);
  void changed();

  BehaviourTools tools_;
  std::vector<Task> tasks_;  ///< the running one first, then by priority
  std::uint32_t last_id_ = 0;
  TaskReport last_;
  BehaviourReport report_;
  std::vector<TaskReport> ended_;
  bool stop_ = false;  ///< the executor must be told
};

}  // namespace pilothouse
