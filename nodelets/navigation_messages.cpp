#include "nodelets/navigation_messages.hpp"

#include <cmath>
#include <limits>

namespace pilothouse {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

geometry_msgs::Pose poseOf(const Pose2& pose) {
  geometry_msgs::Pose message;
  message.position.x = pose.x;
  message.position.y = pose.y;
  message.orientation.z = std::sin(0.5 * pose.heading);
  message.orientation.w = std::cos(0.5 * pose.heading);
  return message;
}

MapCell kindOf(const Object& object) {
  if (object.kind == Object::DROP_OFF) return MapCell::kDropOff;
  return object.kind == Object::THRESHOLD ? MapCell::kThreshold : MapCell::kOccupied;
}

}  // namespace

nav_msgs::Path toPath(const std::string& frame, const std::vector<Pose2>& poses, bool end_heading) {
  nav_msgs::Path path;
  path.header.stamp = ros::Time::now();
  path.header.frame_id = frame;
  path.poses.resize(poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    path.poses[i].header = path.header;
    path.poses[i].pose = poseOf(poses[i]);
  }
  if (!end_heading && !path.poses.empty()) path.poses.back().pose.orientation = {};
  return path;
}

NavigationState toMessage(const std::string& frame, const BehaviourReport& report) {
  const NavigationStatus& status = report.navigation;
  NavigationState message;
  message.header.stamp = ros::Time::now();
  message.header.frame_id = frame;
  message.state = static_cast<std::uint8_t>(status.phase);
  message.text = status.text;
  message.goal.x = status.goal.place.x();
  message.goal.y = status.goal.place.y();
  message.goal.theta = status.goal.heading.value_or(std::nan(""));
  message.point = static_cast<std::uint32_t>(report.point);
  message.points = static_cast<std::uint32_t>(report.points);
  message.plans = status.plans;
  message.distance_left = status.distance_left ? static_cast<float>(*status.distance_left) : kNan;
  message.time_left = status.time_left ? static_cast<float>(*status.time_left) : kNan;
  message.has_nearest = status.nearest ? 1 : 0;
  if (status.nearest) {
    message.nearest.x = static_cast<float>(status.nearest->x());
    message.nearest.y = static_cast<float>(status.nearest->y());
  }
  return message;
}

TaskState toMessage(const TaskerOutput& output, const std::string& refused) {
  TaskState message;
  message.header.stamp = ros::Time::now();
  message.id = output.task.id;
  message.behaviour = output.task.behaviour;
  message.state = static_cast<std::uint8_t>(output.task.phase);
  message.text = output.task.text;
  message.waiting = output.waiting;
  message.refused = refused;
  return message;
}

ExecutorReport reportOf(const RouteState& state, const ros::Time& ordered) {
  ExecutorReport report;
  const bool never = state.state == RouteState::IDLE && state.route.isZero();
  if (state.route != ordered && !never) return report;
  switch (state.state) {
    case RouteState::IDLE:
      report.state = ExecutorReport::kIdle;
      break;
    case RouteState::DRIVING:
      report.state = ExecutorReport::kDriving;
      break;
    case RouteState::WAITING:
      report.state = ExecutorReport::kWaiting;
      break;
    case RouteState::REACHED:
      report.state = ExecutorReport::kReached;
      break;
    case RouteState::REFUSED:
      report.state = ExecutorReport::kRefused;
      break;
    default:
      break;
  }
  report.stamp = state.header.stamp.toSec();
  report.text = state.text;
  return report;
}

std::vector<Planner::Mark> marksOf(const ObjectList& objects, const Pose2& T_map_base) {
  std::vector<Planner::Mark> marks;
  marks.reserve(objects.objects.size());
  const auto bySight = [&objects](const Object& object) {
    return object.source < objects.sources.size() &&
           objects.sources[object.source].name == "camera";
  };
  for (const Object& object : objects.objects) {
    if (!bySight(object)) continue;
    const Eigen::Vector2d place(static_cast<double>(object.position.x),
                                static_cast<double>(object.position.y));
    const double size = static_cast<double>(object.size);
    if (!place.allFinite() || !(size >= 0.0 && size <= 5.0)) continue;
    marks.push_back({T_map_base * place, 0.5 * size, kindOf(object), object.remembered != 0});
  }
  return marks;
}

}  // namespace pilothouse
