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
ExecutorReport reportOf(const RouteState& state);

/// What is seen, as marks on the map. @param T_map_base when it was seen.
std::vector<Planner::Mark> marksOf(const ObjectList& objects, const Pose2& T_map_base);

}  // namespace pilothouse
