#include "gui/model/conversions_place.hpp"

#include <algorithm>
#include <cmath>

#include "doors/goal_views.hpp"
#include "doors/map_views.hpp"
#include "gui/model/conversions_drive.hpp"

namespace pilothouse::gui {

namespace {

// The console's phases are the messages' numbers.
static_assert(NavigationState::FAILED == static_cast<int>(NavigationPhase::kFailed));
static_assert(NavigationState::PAUSING == static_cast<int>(NavigationPhase::kPausing));
static_assert(NavigationState::LOOKING == static_cast<int>(NavigationPhase::kLooking));
static_assert(NavigationState::WAITING == static_cast<int>(NavigationPhase::kWaiting));
static_assert(TaskState::PAUSED == static_cast<int>(TaskPhase::kPaused));
static_assert(TaskState::FAILED == static_cast<int>(TaskPhase::kFailed));

constexpr double kFarthest = 1.0e4;      // [m]
constexpr std::size_t kMostWaiting = 8;  // behaviours
constexpr int kPlanar[3] = {0, 1, 5};    // x, y and turn about z, of six

bool within(double value, double most) {
  return std::abs(value) <= most;  // false for NaN
}

bool isPlace(double x, double y) {
  return within(x, kFarthest) && within(y, kFarthest);
}

geometry_msgs::Quaternion turnOf(double heading) {
  geometry_msgs::Quaternion turn;
  turn.z = std::sin(0.5 * heading);
  turn.w = std::cos(0.5 * heading);
  return turn;
}

/// NaN: unknown; anything else that is no length is taken for that too: it is only told.
double leftOf(float value) {
  return value >= 0.0F && value < 1e6F ? double(value) : kUnknown;
}

}  // namespace

Checked<std::shared_ptr<const MapPicture>> mapFromMessage(const MapGrid& grid) {
  using Result = Checked<std::shared_ptr<const MapPicture>>;
  const std::size_t cells = std::size_t{grid.info.width} * grid.info.height;
  if (cells > kMostMapCells) {
    return Result::refused("map is " + std::to_string(grid.info.width) + " x " +
                           std::to_string(grid.info.height) +
                           " cells, expected at most 36 million in all");
  }
  const auto map = openMap(grid);
  if (!map) return Result::refused(map.reason());
  auto picture = std::make_shared<MapPicture>();
  picture->cells = *map;
  picture->levels = mapLevels(picture->cells);
  picture->frame = plainText(grid.header.frame_id, 64);
  picture->version = grid.version;
  return Result::of(std::move(picture));
}

Checked<PoseReading> poseFromMessage(const geometry_msgs::PoseWithCovarianceStamped& message) {
  using Result = Checked<PoseReading>;
  const auto& place = message.pose.pose.position;
  geometry_msgs::TransformStamped as_transform;
  as_transform.header = message.header;
  as_transform.transform.translation.x = place.x;
  as_transform.transform.translation.y = place.y;
  as_transform.transform.rotation = message.pose.pose.orientation;
  const auto pose = openTransform(as_transform);
  if (!pose || !isPlace(place.x, place.y)) {
    return Result::refused("pose is at " + std::to_string(place.x) + " " + std::to_string(place.y) +
                           ", expected a place within 10 km and a unit quaternion");
  }
  PoseReading reading;
  reading.pose = *pose;
  reading.frame = plainText(message.header.frame_id, 64);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      reading.covariance(row, column) =
          message.pose.covariance[static_cast<std::size_t>(6 * kPlanar[row] + kPlanar[column])];
    }
  }
  const auto& c = reading.covariance;
  reading.spread_known = c.allFinite() && c(0, 0) >= 0.0 && c(1, 1) >= 0.0 && c(2, 2) >= 0.0 &&
                         c(0, 0) + c(1, 1) > 0.0 && c(0, 0) < 1e4 && c(1, 1) < 1e4;
  return Result::of(reading);
}

Checked<NavigationReading> navigationFromMessage(const NavigationState& m) {
  using Result = Checked<NavigationReading>;
  if (m.state > NavigationState::FAILED) {
    return Result::refused("state " + std::to_string(m.state) + ", expected 0 to 8");
  }
  if (!isPlace(m.goal.x, m.goal.y)) return Result::refused("goal is not a place within 10 km");
  NavigationReading r;
  r.phase = static_cast<NavigationPhase>(m.state);
  r.text = plainText(m.text);
  r.goal = {m.goal.x, m.goal.y};
  if (std::isfinite(m.goal.theta)) r.heading = m.goal.theta;
  r.point = m.point;
  r.points = m.points;
  r.plans = m.plans;
  r.distance_left = leftOf(m.distance_left);
  r.time_left = leftOf(m.time_left);
  const auto& nearest = m.nearest;
  if (m.has_nearest && isPlace(double(nearest.x), double(nearest.y))) {
    r.nearest = Eigen::Vector2d(double(nearest.x), double(nearest.y));
  }
  return Result::of(r);
}

Checked<TaskReading> taskFromMessage(const TaskState& m) {
  if (m.state > TaskState::FAILED) {
    return Checked<TaskReading>::refused("state " + std::to_string(m.state) + ", expected 0 to 5");
  }
  TaskReading r;
  r.id = m.id;
  r.behaviour = plainText(m.behaviour, 32);
  r.phase = static_cast<TaskPhase>(m.state);
  r.text = plainText(m.text);
  for (const auto& name : m.waiting) {
    if (r.waiting.size() == kMostWaiting) break;
    r.waiting.push_back(plainText(name, 32));
  }
  r.refused = plainText(m.refused);
  return Checked<TaskReading>::of(r);
}

Checked<PathReading> pathFromMessage(const nav_msgs::Path& path) {
  using Result = Checked<PathReading>;
  if (path.poses.size() > kMostPathPoints) {
    return Result::refused(std::to_string(path.poses.size()) + " poses, expected at most " +
                           std::to_string(kMostPathPoints));
  }
  PathReading r;
  r.frame = plainText(path.header.frame_id, 64);
  r.points.reserve(path.poses.size());
  for (const auto& pose : path.poses) {
    const auto& p = pose.pose.position;
    if (!isPlace(p.x, p.y)) {
      return Result::refused("pose " + std::to_string(r.points.size()) +
                             " is not a place within 10 km");
    }
    if (!r.points.empty()) r.length += (Eigen::Vector2d(p.x, p.y) - r.points.back()).norm();
    r.points.emplace_back(p.x, p.y);
  }
  return Result::of(std::move(r));
}

Checked<Preview> previewFromResponse(const PlanPath::Response& response, std::uint32_t id) {
  using Result = Checked<Preview>;
  Preview preview;
  preview.id = id;
  preview.answered = true;
  preview.found = response.found != 0;
  preview.why = plainText(response.message);
  const auto path = pathFromMessage(response.path);
  if (!path) return Result::refused("the path: " + path.reason());
  preview.path = *path;
  if (preview.found && preview.path.points.empty()) return Result::refused("a path without poses");
  // As long as a task may take: a time that is no time is left unknown.
  const auto time = static_cast<double>(response.time);
  preview.time = time >= 0.0 && time < 1e7 ? time : kUnknown;
  const auto& nearest = response.nearest;
  if (response.has_nearest) {
    if (!isPlace(double(nearest.x), double(nearest.y))) {
      return Result::refused("the nearest place is not within 10 km");
    }
    preview.nearest = Eigen::Vector2d(double(nearest.x), double(nearest.y));
  }
  return Result::of(std::move(preview));
}

Checked<RouteDraft> routeFromResponse(const GoalRoute& route) {
  using Result = Checked<RouteDraft>;
  const auto wish = openGoalRoute(route);
  if (!wish) return Result::refused(wish.reason());
  RouteDraft draft;
  draft.name = plainText(route.name, 64);
  draft.loop = wish->loop;
  for (const auto& stop : wish->stops) {
    draft.points.push_back({{stop.goal.place, stop.goal.heading}, stop.pause});
  }
  return Result::of(std::move(draft));
}

geometry_msgs::Pose toPose(const PlaceGoal& goal) {
  geometry_msgs::Pose pose;
  pose.position.x = goal.place.x();
  pose.position.y = goal.place.y();
  if (goal.heading) pose.orientation = turnOf(*goal.heading);
  return pose;
}

GoalRoute toMessage(const RouteDraft& draft, const std::string& frame) {
  GoalRoute route;
  route.header.frame_id = frame;
  route.name = draft.name;
  route.loop = draft.loop ? 1 : 0;
  for (const auto& point : draft.points) {
    RoutePoint message;
    message.x = point.goal.place.x();
    message.y = point.goal.place.y();
    message.heading = point.goal.heading.value_or(std::nan(""));
    message.pause = static_cast<float>(point.pause);
    route.points.push_back(message);
  }
  return route;
}

geometry_msgs::PoseWithCovarianceStamped toMessage(const Pose2& pose, const PoseSpread& spread) {
  geometry_msgs::PoseWithCovarianceStamped message;
  message.pose.pose = toPose({{pose.x, pose.y}, pose.heading});
  message.pose.covariance[0] = message.pose.covariance[7] = spread.place * spread.place;
  message.pose.covariance[35] = spread.heading * spread.heading;
  return message;
}

}  // namespace pilothouse::gui
