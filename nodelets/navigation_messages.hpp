#pragma once

#include <nav_msgs/Path.h>
#include <pilothouse/NavigationState.h>
#include <pilothouse/ObjectList.h>
#include <pilothouse/RouteState.h>
#include <pilothouse/TaskState.h>

#include <string>
#include <vector>

#include "core/tasks/tasker.hpp"

namespace pilothouse {

/// Poses with their headings. @param end_heading false: the last has none (zeros).
nav_msgs::Path toPath(const std::string& frame, const std::vector<Pose2>& poses,
                      bool end_heading = true);

NavigationState toMessage(const std::string& frame, const BehaviourReport& report);
TaskState toMessage(const TaskerOutput& output, const std::string& refused);
/// A report on another route than the one ordered last is none; of an executor that was given no
/// route yet, that it is idle is true of any.
ExecutorReport reportOf(const RouteState& state, const ros::Time& ordered);

/// What the camera sees, as marks on the map. A ranger's objects are where its echo may have come
/// from: reason to be careful there, but no place to plan round. @param T_map_base when it was
/// seen.
std::vector<Planner::Mark> marksOf(const ObjectList& objects, const Pose2& T_map_base);

}  // namespace pilothouse
