#include "nodelets/navigation_loop.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "doors/goal_views.hpp"
#include "doors/map_views.hpp"
#include "doors/motion_views.hpp"
#include "doors/steady_clock.hpp"

namespace pilothouse {
namespace {

constexpr double kFresh = 5.0;       // older lists of objects mark nothing [s]
constexpr double kHandFresh = 0.5;   // since a command of a person that moves the robot [s]
constexpr double kStopFresh = 1.0;   // [s]
constexpr double kSaidEvery = 0.25;  // what has not changed [s]
constexpr double kStill = 1e-3;      // a wish below this moves nothing [m/s, rad/s]

constexpr BasePose::Limits kOldest{0.5, 1.0};

}  // namespace

NavigationLoop::NavigationLoop(const RobotDescription& robot, ros::NodeHandle& handle,
                               const NavigatorSettings& settings)
    : settings_(settings),
      planner_(settings.planning, robot.outline(), robot.drive.kind),
      tasker_({planner_, settings.navigation}),
      pose_(settings.odom_frame, kOldest) {
  route_ = handle.advertise<nav_msgs::Path>("route", 4, true);
  path_ = handle.advertise<nav_msgs::Path>("path", 4, true);
  navigation_ = handle.advertise<NavigationState>("navigation_state", 10, true);
  task_ = handle.advertise<TaskState>("task_state", 10, true);
}

std::string NavigationLoop::take(const MapGrid& grid) {
  if (grid.header.frame_id != settings_.map_frame) {
    return "a map in another frame than " + settings_.map_frame;
  }
  const auto map = openMap(grid);
  if (!map) return map.reason();
  if (map->cells.empty()) return "a map without cells";
  try {
    planner_.setMap(*map);
  } catch (const std::invalid_argument& fault) {
    return fault.what();
  }
  return {};
}

std::string NavigationLoop::take(const ObjectList& objects) {
  objects_ = objects;
  objects_at_ = steadyNow();
  return {};
}

std::string NavigationLoop::take(const RouteState& state) {
  input_.navigation.executor = reportOf(state, ordered_);
  return {};
}

std::string NavigationLoop::take(const StopState& state) {
  stopped_ = state.state == StopState::STOPPED;
  stop_at_ = steadyNow();
  return {};
}

std::string NavigationLoop::take(const geometry_msgs::TwistStamped& by_hand) {
  const auto& t = by_hand.twist;
  const double speed = std::abs(t.linear.x) + std::abs(t.linear.y) + std::abs(t.angular.z);
  if (!std::isfinite(speed)) return "the command is not finite";
  if (speed < kStill) return {};
  if (steadyNow() - hand_at_ > kHandFresh) {
    Wish wish;
    wish.behaviour = "hand";
    submit(wish);
  }
  hand_at_ = steadyNow();
  return {};
}

Checked<std::uint32_t> NavigationLoop::refuse(const std::string& reason) {
  refused_ = reason;
  published_ = -1e9;
  return Checked<std::uint32_t>::refused(reason);
}

Checked<std::uint32_t> NavigationLoop::submit(const Wish& wish) {
  const auto task = tasker_.submit(wish);
  if (!task) return refuse(task.reason());
  refused_.clear();
  return task;
}

Checked<Goal> NavigationLoop::goalOf(const geometry_msgs::PoseStamped& pose) const {
  using Result = Checked<Goal>;
  const auto goal = openGoal(pose);
  if (!goal) return goal;
  std::string fault;
  const auto T_map_goal = pose_.transform(settings_.map_frame, pose.header.frame_id, fault);
  if (!T_map_goal) return Result::refused("goal: " + fault);
  return Result::of(moved(*T_map_goal, *goal));
}

Checked<std::uint32_t> NavigationLoop::goTo(const geometry_msgs::PoseStamped& pose) {
  const auto goal = goalOf(pose);
  if (!goal) return refuse(goal.reason());
  Wish wish;
  wish.behaviour = "go_to";
  wish.stops = {{*goal, 0.0}};
  return submit(wish);
}

Checked<std::uint32_t> NavigationLoop::follow(const GoalRoute& route) {
  const auto wish = openGoalRoute(route);
  if (!wish) return refuse(wish.reason());
  const std::string& frame = route.header.frame_id;
  std::string fault;
  const auto T_map_route =
      pose_.transform(settings_.map_frame, frame.empty() ? settings_.map_frame : frame, fault);
  if (!T_map_route) return refuse("route: " + fault);
  Wish there = *wish;
  for (RouteStop& stop : there.stops) stop.goal = moved(*T_map_route, stop.goal);
  return submit(there);
}

std::optional<Pose2> NavigationLoop::pose() const {
  std::string fault;
  return pose_.in(settings_.map_frame, fault);
}

Plan NavigationLoop::plan(const geometry_msgs::PoseStamped& goal,
                          const geometry_msgs::PoseStamped& start, std::string& fault) {
  Plan none;
  none.why = NoWay::kNotFinite;
  const auto there = goalOf(goal);
  if (!there) {
    fault = there.reason();
    return none;
  }
  std::optional<Pose2> here;
  if (start.header.frame_id.empty()) {
    here = pose_.in(settings_.map_frame, fault);
  } else if (const auto from = goalOf(start)) {
    here = Pose2{from->place.x(), from->place.y(), from->heading.value_or(0.0)};
  } else {
    fault = "start: " + from.reason();
  }
  if (!here) return none;
  look(steadyNow());
  Plan plan = planner_.plan({*here, there->place, there->heading});
  if (!plan) fault = textOf(plan.why);
  return plan;
}

/// What was seen last enters the planner's map, from where the base was at that time: from where it
/// is now, marks would swing along with a robot that turns, and shut it in.
void NavigationLoop::look(double now) {
  if (!planner_.hasMap()) return;
  std::string fault;
  if (now - objects_at_ > kFresh) {
    planner_.mark({});
  } else if (const auto T_map_base =
                 pose_.at(objects_.header.stamp.toSec(), settings_.map_frame, fault)) {
    planner_.markSeen(marksOf(objects_, *T_map_base), *T_map_base);
  }
}

const TaskerOutput& NavigationLoop::step() {
  const double now = steadyNow();
  look(now);
  NavigationInput& navigation = input_.navigation;
  navigation.now = ros::Time::now().toSec();
  navigation.pose = pose_.in(settings_.map_frame, pose_fault_);
  navigation.halted = stopped_ && now - stop_at_ < kStopFresh;
  input_.hand = now - hand_at_ < kHandFresh;
  output_ = tasker_.step(input_);
  if (output_.order) send(*output_.order);
  publish();
  return output_;
}

void NavigationLoop::send(const DriveOrder& order) {
  nav_msgs::Path route = toPath(settings_.map_frame, order.poses, order.heading.has_value());
  if (order.heading && !route.poses.empty()) {
    route.poses.back().pose.orientation.z = std::sin(0.5 * *order.heading);
    route.poses.back().pose.orientation.w = std::cos(0.5 * *order.heading);
  }
  keepOpen(route);
  // A clock that stands would give two routes one stamp, by which the executor's reports tell them.
  if (route.header.stamp == ordered_) route.header.stamp += ros::Duration(0, 1);
  ordered_ = route.header.stamp;
  input_.navigation.executor = ExecutorReport();
  route_.publish(route);
}

void NavigationLoop::publish() {
  const BehaviourReport& report = output_.behaviour;
  const auto same = [](const Pose2& a, const Pose2& b) {
    return a.x == b.x && a.y == b.y && a.heading == b.heading;
  };
  const std::vector<Pose2>& way = report.navigation.path;
  if (!std::equal(way.begin(), way.end(), shown_.begin(), shown_.end(), same)) {
    shown_ = way;
    path_.publish(toPath(settings_.map_frame, shown_));
  }
  const NavigationState navigation = toMessage(settings_.map_frame, report);
  const TaskState task = toMessage(output_, refused_);
  const bool changed = navigation.state != last_navigation_.state ||
                       navigation.text != last_navigation_.text ||
                       navigation.point != last_navigation_.point || task.id != last_task_.id ||
                       task.state != last_task_.state || task.text != last_task_.text ||
                       task.waiting != last_task_.waiting || task.refused != last_task_.refused;
  const double now = steadyNow();
  if (!changed && now - published_ < kSaidEvery) return;
  published_ = now;
  last_navigation_ = navigation;
  last_task_ = task;
  navigation_.publish(navigation);
  task_.publish(task);
}

}  // namespace pilothouse
