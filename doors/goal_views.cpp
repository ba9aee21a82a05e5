#include "doors/goal_views.hpp"

#include <cmath>
#include <string>

#include "core/tasks/route_faults.hpp"

namespace pilothouse {
namespace {

/// Rotation about z, or NaN when it is no unit quaternion.
double headingOf(const geometry_msgs::Quaternion& q) {
  const double norm = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
  if (!(std::abs(norm - 1.0) < 1e-2)) return std::nan("");
  return std::atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z));
}

std::string asText(const geometry_msgs::Quaternion& q) {
  return std::to_string(q.x) + " " + std::to_string(q.y) + " " + std::to_string(q.z) + " " +
         std::to_string(q.w);
}

}  // namespace

Checked<Goal> openGoal(const geometry_msgs::PoseStamped& pose) {
  using Result = Checked<Goal>;
  const auto& place = pose.pose.position;
  const auto& turn = pose.pose.orientation;
  Goal goal;
  goal.place = {place.x, place.y};
  const bool any = turn.x == 0.0 && turn.y == 0.0 && turn.z == 0.0 && turn.w == 0.0;
  if (!any) {
    goal.heading = headingOf(turn);
    if (!std::isfinite(*goal.heading)) {
      return Result::refused("goal: orientation is " + asText(turn) +
                             ", expected a unit quaternion, or zeros for any");
    }
  }
  Wish wish;
  wish.stops = {{goal, 0.0}};
  const std::string fault = faultOfStops(wish);
  return fault.empty() ? Result::of(goal) : Result::refused("goal: " + fault.substr(9));
}

Checked<Wish> openGoalRoute(const GoalRoute& route) {
  using Result = Checked<Wish>;
  Wish wish;
  wish.behaviour = "route";
  wish.loop = route.loop != 0;
  if (route.points.size() > kMostStops) {
    return Result::refused("route: " + std::to_string(route.points.size()) +
                           " points, expected at most " + std::to_string(kMostStops));
  }
  for (const auto& point : route.points) {
    RouteStop stop;
    stop.goal.place = {point.x, point.y};
    if (!std::isnan(point.heading)) stop.goal.heading = point.heading;
    stop.pause = static_cast<double>(point.pause);
    wish.stops.push_back(stop);
  }
  const std::string fault = faultOfStops(wish);
  return fault.empty() ? Result::of(wish) : Result::refused("route: " + fault);
}

Checked<Pose2> openTransform(const geometry_msgs::TransformStamped& transform) {
  const auto& place = transform.transform.translation;
  const Pose2 pose{place.x, place.y, headingOf(transform.transform.rotation)};
  if (pose.finite()) return Checked<Pose2>::of(pose);
  return Checked<Pose2>::refused("transform from " + transform.child_frame_id + " to " +
                                 transform.header.frame_id + " is not finite");
}

Goal moved(const Pose2& T_to_from, const Goal& goal) {
  Goal there;
  there.place = T_to_from * goal.place;
  if (goal.heading) there.heading = wrapped(T_to_from.heading + *goal.heading);
  return there;
}

}  // namespace pilothouse
