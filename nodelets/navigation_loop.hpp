#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TwistStamped.h>
#include <pilothouse/GoalRoute.h>
#include <pilothouse/MapGrid.h>
#include <pilothouse/PlanPath.h>
#include <pilothouse/StopState.h>
#include <ros/node_handle.h>

#include <memory>
#include <optional>
#include <string>

#include "core/tasks/tasker.hpp"
#include "doors/robot_description.hpp"
#include "nodelets/base_pose.hpp"
#include "nodelets/navigation_messages.hpp"

namespace pilothouse {

struct NavigatorSettings {
  PlanningParameters planning;
  NavigationParameters navigation;
  std::string map_frame = "map", odom_frame = "odom";
  std::string routes_folder;
};

/// @throws ParameterFault listing every fault.
NavigatorSettings readNavigatorSettings(const ros::NodeHandle& own);

/// Planner and tasker, fed by messages: the navigator without its subscriptions. Each take()
/// returns why it refused the message; empty: it did not. One thread at a time.
class NavigationLoop {
 public:
  NavigationLoop(const RobotDescription& robot, ros::NodeHandle& handle,
                 const NavigatorSettings& settings);

  std::string take(const MapGrid& grid);
  std::string take(const ObjectList& objects);
  std::string take(const nav_msgs::Odometry& odometry) { return pose_.take(odometry); }
  std::string take(const RouteState& state);
  std::string take(const StopState& state);
  std::string take(const geometry_msgs::TwistStamped& by_hand);

  /// @return the task's id, or why there is none; that is also told in the task's state.
  Checked<std::uint32_t> goTo(const geometry_msgs::PoseStamped& pose);
  Checked<std::uint32_t> follow(const GoalRoute& route);
  /// @param start without a frame: where the robot is.
  Plan plan(const geometry_msgs::PoseStamped& goal, const geometry_msgs::PoseStamped& start,
            std::string& fault);
  double cruise() const { return settings_.navigation.cruise; }  ///< [m/s]
  Tasker& tasker() { return tasker_; }
  const std::string& mapFrame() const { return settings_.map_frame; }
  std::optional<Pose2> pose() const;

  /// Decides and publishes. @return what the tasker said.
  const TaskerOutput& step();

 private:
  Checked<Goal> goalOf(const geometry_msgs::PoseStamped& pose) const;
  Checked<std::uint32_t> submit(const Wish& wish);
  Checked<std::uint32_t> refuse(const std::string& reason);
  void look(double now);
  void send(const DriveOrder& order);
  void publish();

  NavigatorSettings settings_;
  Planner planner_;
  Tasker tasker_;
  BasePose pose_;
  TaskInput input_;
  TaskerOutput output_;
  ros::Time ordered_;  ///< stamp of the newest route
  ObjectList objects_;
  double objects_at_ = -1e9, hand_at_ = -1e9, stop_at_ = -1e9;  ///< steady clock [s]
  bool stopped_ = false;
  std::string refused_, pose_fault_;
  ros::Publisher route_, path_, navigation_, task_;
  std::vector<Pose2> shown_;
  NavigationState last_navigation_;
  TaskState last_task_;
  double published_ = -1e9;
};

}  // namespace pilothouse
