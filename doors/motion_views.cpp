#include "doors/motion_views.hpp"

#include <cmath>
#include <string>

namespace pilothouse {
namespace {

constexpr double kFarthest = 1e4;  // [m]
constexpr std::size_t kMostPoints = 1000;
constexpr std::size_t kFewestOfLoop = 4;
constexpr double kClosed = 1e-3;            // ends nearer than this make a loop [m]
constexpr std::uint32_t kMostCells = 4096;  // a side

bool isPlace(double x, double y) {
  return std::abs(x) <= kFarthest && std::abs(y) <= kFarthest;
}

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

Twist2 planar(const geometry_msgs::Twist& twist) {
  return {twist.linear.x, twist.linear.y, twist.angular.z};
}

std::string faultOf(const FloorGrid& grid) {
  const auto& info = grid.info;
  if (info.width == 0 || info.height == 0 || info.width > kMostCells || info.height > kMostCells) {
    return "grid is " + std::to_string(info.width) + " x " + std::to_string(info.height) +
           " cells, expected 1 to " + std::to_string(kMostCells) + " a side";
  }
  if (!(info.resolution >= 0.001F && info.resolution <= 10.0F)) {
    return "resolution is " + std::to_string(info.resolution) + ", expected 0.001 to 10 m";
  }
  const auto& place = info.origin.position;
  const auto& turn = info.origin.orientation;
  if (!isPlace(place.x, place.y) ||
      !(std::abs(turn.x) < 1e-6 && std::abs(turn.y) < 1e-6 && std::abs(turn.z) < 1e-6)) {
    return "origin is far away or turned, expected a place within 10 km and no rotation";
  }
  const std::size_t cells = std::size_t{info.width} * info.height;
  if (grid.classes.size() != cells || grid.heights.size() != cells) {
    return "classes and heights are " + std::to_string(grid.classes.size()) + " and " +
           std::to_string(grid.heights.size()) + ", expected " + std::to_string(cells);
  }
  return {};
}

}  // namespace

Checked<RangeReading> openReading(const sensor_msgs::Range& range) {
  using Result = Checked<RangeReading>;
  const RangeReading reading{
      static_cast<double>(range.range), static_cast<double>(range.field_of_view),
      static_cast<double>(range.min_range), static_cast<double>(range.max_range)};
  if (std::isnan(reading.range)) return Result::refused("range is nan, expected a number");
  if (!(reading.field_of_view > 0.0 && reading.field_of_view <= 3.1416)) {
    return Result::refused("field_of_view is " + std::to_string(reading.field_of_view) +
                           ", expected above 0 to 3.1416 rad");
  }
  if (!(reading.min_range >= 0.0 && reading.max_range > reading.min_range &&
        reading.max_range <= 1000.0)) {
    return Result::refused("min_range and max_range are " + std::to_string(reading.min_range) +
                           " and " + std::to_string(reading.max_range) +
                           ", expected 0 <= min_range < max_range <= 1000 m");
  }
  return Result::of(reading);
}

Checked<BaseMotion> openOdometry(const nav_msgs::Odometry& odometry) {
  using Result = Checked<BaseMotion>;
  const auto& pose = odometry.pose.pose;
  BaseMotion motion;
  motion.pose = {pose.position.x, pose.position.y, headingOf(pose.orientation)};
  motion.twist = planar(odometry.twist.twist);
  if (!std::isfinite(motion.pose.heading)) {
    return Result::refused("orientation is " + asText(pose.orientation) +
                           ", expected a unit quaternion");
  }
  if (!(std::abs(motion.pose.x) < 1e6 && std::abs(motion.pose.y) < 1e6)) {
    return Result::refused("position is " + std::to_string(motion.pose.x) + " " +
                           std::to_string(motion.pose.y) + ", expected within 1000 km");
  }
  if (!motion.twist.finite()) return Result::refused("twist is not finite");
  return Result::of(motion);
}

Checked<FloorFrame> openGrid(const FloorGrid& grid, std::vector<CellClass>& classes) {
  using Result = Checked<FloorFrame>;
  const std::string fault = faultOf(grid);
  if (!fault.empty()) return Result::refused(fault);
  classes.resize(grid.classes.size());
  for (std::size_t i = 0; i < classes.size(); ++i) {
    if (grid.classes[i] > static_cast<std::uint8_t>(CellClass::kDropOff)) {
      return Result::refused("a class is " + std::to_string(grid.classes[i]) + ", expected 0 to 4");
    }
    classes[i] = static_cast<CellClass>(grid.classes[i]);
  }
  FloorFrame frame;
  frame.stamp = grid.header.stamp.toSec();
  frame.geometry.x_min = static_cast<float>(grid.info.origin.position.x);
  frame.geometry.y_min = static_cast<float>(grid.info.origin.position.y);
  frame.geometry.cell_size = grid.info.resolution;
  frame.geometry.size_x = static_cast<int>(grid.info.width);
  frame.geometry.size_y = static_cast<int>(grid.info.height);
  frame.classes = classes.data();
  frame.heights = grid.heights.data();
  return Result::of(frame);
}

Checked<Twist2> openCommand(const geometry_msgs::TwistStamped& command) {
  const Twist2 twist = planar(command.twist);
  if (twist.finite()) return Checked<Twist2>::of(twist);
  return Checked<Twist2>::refused("command is " + std::to_string(twist.vx) + " " +
                                  std::to_string(twist.vy) + " " + std::to_string(twist.w) +
                                  ", expected finite speeds");
}

Checked<RouteWish> openRoute(const nav_msgs::Path& path) {
  using Result = Checked<RouteWish>;
  if (path.poses.size() > kMostPoints) {
    return Result::refused(std::to_string(path.poses.size()) + " points, expected at most " +
                           std::to_string(kMostPoints));
  }
  RouteWish wish;
  for (const auto& stamped : path.poses) {
    const auto& place = stamped.pose.position;
    if (!isPlace(place.x, place.y)) {
      return Result::refused("point " + std::to_string(wish.points.size()) + " is " +
                             std::to_string(place.x) + " " + std::to_string(place.y) +
                             ", expected a place within 10 km");
    }
    if (!stamped.header.frame_id.empty() && stamped.header.frame_id != path.header.frame_id) {
      return Result::refused("point " + std::to_string(wish.points.size()) +
                             " is in another frame than the route");
    }
    wish.points.emplace_back(place.x, place.y);
  }
  if (wish.points.empty()) return Result::of(wish);
  wish.loop = wish.points.size() >= kFewestOfLoop &&
              (wish.points.front() - wish.points.back()).norm() < kClosed;
  if (wish.loop) wish.points.pop_back();
  const auto& end = path.poses.back().pose.orientation;
  if (end.x == 0.0 && end.y == 0.0 && end.z == 0.0 && end.w == 0.0) return Result::of(wish);
  wish.heading = headingOf(end);
  if (std::isfinite(*wish.heading)) return Result::of(wish);
  return Result::refused("orientation at the end is " + asText(end) +
                         ", expected a unit quaternion, or zeros for none");
}

void keepOpen(nav_msgs::Path& path) {
  if (path.poses.size() < kFewestOfLoop) return;
  const auto placeOf = [](const geometry_msgs::PoseStamped& pose) {
    return Eigen::Vector2d(pose.pose.position.x, pose.pose.position.y);
  };
  const Eigen::Vector2d last = placeOf(path.poses.back());
  if (!((placeOf(path.poses.front()) - last).norm() < kClosed)) return;
  // Back along the last leg: it came free there.
  const Eigen::Vector2d back = placeOf(path.poses[path.poses.size() - 2]) - last;
  const Eigen::Vector2d direction = back.norm() > 0.0 ? back.normalized() : Eigen::Vector2d(1, 0);
  path.poses.back().pose.position.x += 3.0 * kClosed * direction.x();
  path.poses.back().pose.position.y += 3.0 * kClosed * direction.y();
}

}  // namespace pilothouse
