#pragma once

#include <actionlib/server/simple_action_server.h>
#include <move_base_msgs/MoveBaseAction.h>
#include <nav_msgs/GetPlan.h>

#include "doors/guarded_service.hpp"
#include "nodelets/navigation_loop.hpp"

namespace pilothouse {

/// What clients of move_base know: the action move_base and the service move_base/make_plan. Goals
/// become tasks; how those end becomes the goals' results.
class MoveBaseServer {
 public:
  MoveBaseServer(ros::NodeHandle& handle, NavigationLoop& loop, OnRefused on_refused);
  /// After each step of the loop.
  void look(const TaskerOutput& output);

 private:
  void takeGoal();
  void takePreempt();
  bool makePlan(nav_msgs::GetPlan::Request& request, nav_msgs::GetPlan::Response& response);

  NavigationLoop& loop_;
  actionlib::SimpleActionServer<move_base_msgs::MoveBaseAction> action_;
  ros::ServiceServer make_plan_;
  std::uint32_t task_ = 0;  ///< of the goal under way; 0: none is
};

}  // namespace pilothouse
