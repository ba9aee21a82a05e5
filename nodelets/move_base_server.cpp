#include "nodelets/move_base_server.hpp"

#include <cmath>
#include <utility>

namespace pilothouse {

MoveBaseServer::MoveBaseServer(ros::NodeHandle& handle, NavigationLoop& loop, OnRefused on_refused)
    : loop_(loop), action_(handle, "move_base", false) {
  action_.registerGoalCallback([this] { takeGoal(); });
  action_.registerPreemptCallback([this] { takePreempt(); });
  action_.start();
  make_plan_ = advertiseGuarded<nav_msgs::GetPlan>(
      handle, "move_base/make_plan",
      [this](auto& request, auto& response) { return makePlan(request, response); },
      std::move(on_refused));
}

void MoveBaseServer::takeGoal() {
  const std::uint32_t before = std::exchange(task_, 0);
  const auto goal = action_.acceptNewGoal();  // ends the client's goal before
  const auto task = loop_.goTo(goal->target_pose);
  if (task) {
    task_ = *task;
    return;
  }
  // Nobody could cancel any more what it drove to.
  if (before != 0) loop_.tasker().cancel(before);
  action_.setAborted({}, task.reason());
}

void MoveBaseServer::takePreempt() {
  // A goal that is replaced ends with the task that replaces its own.
  if (task_ != 0 && !action_.isNewGoalAvailable()) loop_.tasker().cancel(task_);
}

void MoveBaseServer::look(const TaskerOutput& output) {
  if (task_ == 0) return;
  for (const TaskReport& ended : output.ended) {
    if (ended.id != task_) continue;
    task_ = 0;
    if (ended.phase == TaskPhase::kDone) action_.setSucceeded({}, "reached");
    if (ended.phase == TaskPhase::kFailed) action_.setAborted({}, ended.text);
    if (ended.phase == TaskPhase::kCancelled) action_.setPreempted({}, ended.text);
    return;
  }
  const auto pose = loop_.pose();
  if (!pose) return;
  move_base_msgs::MoveBaseFeedback feedback;
  feedback.base_position = toPath(loop_.mapFrame(), {*pose}).poses.front();
  action_.publishFeedback(feedback);
}

/// As move_base has it, the start is where the robot stands; without a way the plan is empty.
bool MoveBaseServer::makePlan(nav_msgs::GetPlan::Request& request,
                              nav_msgs::GetPlan::Response& response) {
  std::string fault;
  const Plan plan = loop_.plan(request.goal, {}, fault);
  response.plan = toPath(loop_.mapFrame(), plan.poses);
  if (!plan) ROS_WARN_STREAM("make_plan: " << fault);
  return true;
}

}  // namespace pilothouse
