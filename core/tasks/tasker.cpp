#include "core/tasks/tasker.hpp"

#include <algorithm>
#include <utility>

namespace pilothouse {
namespace {

std::string listOfKinds() {
  std::string names;
  for (const auto& kind : behaviourKinds())
    names += (names.empty() ? "" : ", ") + std::string(kind.name);
  return names;
}

}  // namespace

Checked<std::uint32_t> Tasker::submit(const Wish& wish) {
  using Result = Checked<std::uint32_t>;
  const auto& kinds = behaviourKinds();
  const auto kind = std::find_if(kinds.begin(), kinds.end(),
                                 [&](const BehaviourKind& k) { return k.name == wish.behaviour; });
  if (kind == kinds.end()) {
    return Result::refused("behaviour is \"" + wish.behaviour.substr(0, 64) + "\", expected " +
                           listOfKinds());
  }
  const std::string fault = kind->faultOf(wish);
  if (!fault.empty()) return Result::refused(fault);
  Task task;
  task.behaviour = kind->make(wish, tools_);
  task.kind = &*kind;
  task.id = ++last_id_;
  const std::uint32_t running = tasks_.empty() ? 0 : tasks_.front().id;
  for (std::size_t i = tasks_.size(); i-- > 0;) {
    if (tasks_[i].kind->priority != kind->priority) continue;
    end(i, TaskPhase::kCancelled, "replaced by a newer " + std::string(kind->name));
  }
  const auto before = std::find_if(tasks_.begin(), tasks_.end(), [&](const Task& other) {
    return other.kind->priority < kind->priority;
  });
  tasks_.insert(before, std::move(task));
  if (tasks_.front().id != running) {
    for (std::size_t i = 1; i < tasks_.size(); ++i) tasks_[i].aside = true;
    changed();
  }
  return Result::of(last_id_);
}

void Tasker::changed() {
  stop_ = true;
  report_ = {};
  if (Task* task = current(); task != nullptr && task->aside) {
    task->aside = false;
    task->behaviour->resume();
  }
}

void Tasker::end(std::size_t place, TaskPhase phase, const std::string& text) {
  last_ = {tasks_[place].id, tasks_[place].kind->name, phase, text};
  ended_.push_back(last_);
  tasks_.erase(tasks_.begin() + static_cast<std::ptrdiff_t>(place));
}

/// What a person means who pauses or cancels: while they drive by hand, what goes on after that.
Tasker::Task* Tasker::asked() {
  const auto task =
      std::find_if(tasks_.begin(), tasks_.end(), [](const Task& t) { return t.kind->asked; });
  return task == tasks_.end() ? nullptr : &*task;
}

std::string Tasker::pause() {
  Task* const task = asked();
  if (task == nullptr) return "nothing runs";
  if (task->paused) return "it is paused already";
  task->paused = true;
  if (task == current()) stop_ = true;
  return {};
}

std::string Tasker::resume() {
  Task* const task = asked();
  if (task == nullptr || !task->paused) return "nothing is paused";
  task->paused = false;
  task->behaviour->resume();
  return {};
}

std::string Tasker::cancel(std::uint32_t id) {
  if (const Task* const task = asked(); id == 0) {
    if (task == nullptr) return "nothing runs";
    id = task->id;
  }
  const auto task =
      std::find_if(tasks_.begin(), tasks_.end(), [id](const Task& t) { return t.id == id; });
  if (task == tasks_.end()) return "task " + std::to_string(id) + " has ended already";
  const auto place = static_cast<std::size_t>(task - tasks_.begin());
  end(place, TaskPhase::kCancelled, "cancelled");
  if (place == 0) changed();
  return {};
}

std::string Tasker::skip() {
  Task* const task = asked();
  return task == nullptr ? "nothing runs" : task->behaviour->skip();
}

TaskerOutput Tasker::step(const TaskInput& input) {
  TaskerOutput output;
  const auto stops = [&output, this] {
    if (std::exchange(stop_, false)) output.order = DriveOrder{};
  };
  stops();
  if (Task* task = current(); task != nullptr && !task->paused) {
    report_ = task->behaviour->step(input);
    if (report_.order) output.order = std::exchange(report_.order, std::nullopt);
    if (report_.state != BehaviourReport::kRunning) {
      const bool done = report_.state == BehaviourReport::kDone;
      const BehaviourReport last = report_;
      end(0, done ? TaskPhase::kDone : TaskPhase::kFailed, report_.text);
      // What it was at stays to be seen until the next one steps.
      if (!tasks_.empty()) changed();
      report_ = last;
    }
  }
  output.task = last_;
  if (const Task* task = current(); task != nullptr) {
    output.task = {task->id, task->kind->name,
                   task->paused ? TaskPhase::kPaused : TaskPhase::kRunning,
                   task->paused ? "paused" : report_.text};
    for (std::size_t i = 1; i < tasks_.size(); ++i) output.waiting.push_back(tasks_[i].kind->name);
  }
  output.behaviour = report_;
  output.ended = std::exchange(ended_, {});
  return output;
}

}  // namespace pilothouse
