#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <pilothouse/GoalRoute.h>

#include "core/cloud/checked.hpp"
#include "core/tasks/behaviour.hpp"

namespace pilothouse {

/// A goal as asked for: finite, within 10 km; an orientation of zeros means any heading, else a
/// unit quaternion.
/// @return in the message's own frame.
Checked<Goal> openGoal(const geometry_msgs::PoseStamped& pose);

/// A route as asked for, as the wish for one: at most 1,000 points.
Checked<Wish> openGoalRoute(const GoalRoute& route);

/// A transform on the floor: finite, a unit quaternion; tilt is left out.
Checked<Pose2> openTransform(const geometry_msgs::TransformStamped& transform);

/// The same goal seen from another frame. @param T_to_from of the frame that it is in.
Goal moved(const Pose2& T_to_from, const Goal& goal);

}  // namespace pilothouse
