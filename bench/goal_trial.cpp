#include "bench/goal_trial.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <utility>

#include "bench/drive_loop.hpp"
#include "core/navigation/goal_navigator.hpp"

namespace pilothouse::bench {
namespace {

constexpr double kMoving = 0.01;     // [m/s]
constexpr double kTrailStep = 0.02;  // [m]
constexpr double kOrderDelay = 0.1;  // from when an order is made until the executor has it [s]

ExecutorReport reportOf(const DriveStep& step) {
  ExecutorReport report;
  report.stamp = step.time;
  report.text = step.executor.text;
  const ExecutorReport::State states[] = {ExecutorReport::kIdle, ExecutorReport::kDriving,
                                          ExecutorReport::kWaiting, ExecutorReport::kReached};
  report.state = states[static_cast<std::size_t>(step.executor.state)];
  return report;
}

/// What the sensors see, as the navigator marks it.
std::vector<Planner::Mark> marksOf(const Surroundings& seen, const Pose2& pose) {
  std::vector<Planner::Mark> marks;
  for (const auto& object : seen.objects) {
    if (seen.sources[object.source].name != "camera") continue;
    const MapCell kind = object.kind == CellClass::kDropOff     ? MapCell::kDropOff
                         : object.kind == CellClass::kThreshold ? MapCell::kThreshold
                                                                : MapCell::kOccupied;
    marks.push_back({pose * object.position.cast<double>(), 0.5 * static_cast<double>(object.size),
                     kind, object.remembered});
  }
  return marks;
}

void drive(DriveLoop& loop, const DriveOrder& order) {
  std::vector<Eigen::Vector2d> points;
  for (const Pose2& pose : order.poses) points.push_back(pose.position());
  loop.drive(points, order.heading, false);
}

/// Keeps what a figure shows.
void note(const NavigationStatus& status, const DriveStep& step, double time, GoalRecord& record) {
  static const char* const kPhases[] = {"idle",        "planning", "driving", "waiting", "looking",
                                        "backing off", "pausing",  "reached", "failed"};
  std::string said = kPhases[static_cast<std::size_t>(status.phase)];
  if (!status.text.empty()) said += ": " + status.text;
  if (record.said.empty() || record.said.back().second != said)
    record.said.emplace_back(time, said);
  if (record.trail.empty() ||
      (step.pose.position() - record.trail.back().position()).norm() > kTrailStep) {
    record.trail.push_back(step.pose);
  }
}

/// One robot on its way to one goal.
class GoalRun {
 public:
  GoalRun(const GoalTask& task, sim::World world, const Errand& errand, GoalResult& result)
      : planner_({}, task.robot->outline(), task.robot->drive.kind),
        navigator_({}, planner_),
        loop_(std::move(world), *task.robot, parametersOf(task)),
        result_(result),
        asked_(loop_.simulation().time()),
        last_(asked_) {
    planner_.setMap(errand.known);
    navigator_.start(errand.goal);
  }
  void drive(double max_seconds) {
    for (int tick = 0; loop_.simulation().time() < max_seconds && !navigator_.ended(); ++tick) {
      step_ = loop_.step();
      result_.driven += step_.twist.linear() * (step_.time - last_);
      last_ = step_.time;
      deliver();
      // At first the camera is still waking up.
      if (loop_.floor() != nullptr && tick % 2 == 0) navigate();
    }
  }
  void judge(const Errand& errand) {
    result_.record.trail.push_back(step_.pose);
    result_.record.marked = planner_.map();
    result_.reached = status_.phase == NavigationPhase::kReached;
    result_.failed = status_.phase == NavigationPhase::kFailed;
    result_.text = status_.text;
    result_.plans = status_.plans;
    result_.seconds = last_ - asked_;
    result_.said_after = result_.seconds + result_.longest_thought;
    result_.off = (step_.pose.position() - errand.goal.place).norm();
    result_.turned_off = std::abs(wrapped(step_.pose.heading - *errand.goal.heading));
    for (const auto& contact : loop_.simulation().base().contacts()) {
      ++(contact.robot_speed > kMoving ? result_.contacts : result_.run_into);
      result_.touched += loop_.simulation().nameOf(contact.model) + " ";
    }
  }

 private:
  static DriveLoopParameters parametersOf(const GoalTask& task) {
    DriveLoopParameters parameters;
    parameters.simulation.sensors.camera = *sim::cameraProfile("kinect_qvga");
    parameters.simulation.sensors.depth_rate = 15.0;
    parameters.simulation.seed = task.seed;
    return parameters;
  }
  void deliver() {
    for (; !orders_.empty() && orders_.front().first <= step_.time + 1e-9; orders_.pop_front()) {
      bench::drive(loop_, orders_.front().second);
    }
  }
  void navigate() {
    planner_.markSeen(marksOf(loop_.surroundings(), step_.pose), step_.pose);
    NavigationInput input;
    input.now = step_.time;
    input.pose = step_.pose;
    input.executor = reportOf(step_);
    const auto before = std::chrono::steady_clock::now();
    const NavigationOutput output = navigator_.step(input);
    const std::chrono::duration<double> thinking = std::chrono::steady_clock::now() - before;
    result_.longest_thought = std::max(result_.longest_thought, thinking.count());
    status_ = output.status;
    note(status_, step_, step_.time - asked_, result_.record);
    if (output.order) orders_.emplace_back(step_.time + kOrderDelay, *output.order);
    if (result_.planned == 0.0) result_.planned = status_.distance_left.value_or(0.0);
  }

  Planner planner_;
  GoalNavigator navigator_;
  DriveLoop loop_;
  GoalResult& result_;
  double asked_, last_;  ///< [s]
  DriveStep step_;
  NavigationStatus status_;
  std::deque<std::pair<double, DriveOrder>> orders_;  ///< on their way, and when they come [s]
};

}  // namespace

GoalResult runGoal(const GoalTask& task, double max_seconds) {
  const auto began = std::chrono::steady_clock::now();
  GoalResult result;
  result.task = task;
  sim::RandomWorld random = worldOf(task);
  const auto errand = errandOf(task, random.world);
  result.possible = errand && errand->possible;
  result.text = "no goal found in this room";
  if (!errand) return result;
  result.shortest = errand->shortest;
  result.record.whole = errand->whole;
  result.record.known = errand->known;
  result.record.goal = errand->goal;
  GoalRun run(task, std::move(random.world), *errand, result);
  run.drive(max_seconds);
  run.judge(*errand);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - began;
  result.wall_seconds = wall.count();
  return result;
}

}  // namespace pilothouse::bench
