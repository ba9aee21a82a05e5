#pragma once

#include <geometry_msgs/TwistStamped.h>
#include <nav_msgs/Odometry.h>
#include <nav_msgs/Path.h>
#include <pilothouse/FloorGrid.h>
#include <sensor_msgs/Range.h>

#include <optional>
#include <vector>

#include "core/cloud/checked.hpp"
#include "core/motion/local_memory.hpp"
#include "core/motion/planar.hpp"
#include "core/motion/range_objects.hpp"

namespace pilothouse {

// What the motion nodelets take in, checked. A refusal names the thing, its value and what was
// expected.

/// A range that is not NaN and limits that can be.
Checked<RangeReading> openReading(const sensor_msgs::Range& range);

struct BaseMotion {
  Pose2 pose;    ///< in the odometry frame
  Twist2 twist;  ///< in the base frame
};
/// Everything finite, a unit quaternion.
Checked<BaseMotion> openOdometry(const nav_msgs::Odometry& odometry);

/// @param classes filled anew; the frame borrows them and the message's heights.
Checked<FloorFrame> openGrid(const FloorGrid& grid, std::vector<CellClass>& classes);

/// A wish for a twist; not finite is refused.
Checked<Twist2> openCommand(const geometry_msgs::TwistStamped& command);

/// A route as asked for.
struct RouteWish {
  std::vector<Eigen::Vector2d> points;  ///< in the path's frame [m]
  std::optional<double> heading;  ///< at the end, where the last pose has an orientation [rad]
  bool loop = false;  ///< it ends where it begins (within 1 mm, four poses or more): over and over
};
/// At most 1,000 poses within 10 km; orientations other than the last are not looked at, and one of
/// zeros means none.
Checked<RouteWish> openRoute(const nav_msgs::Path& path);
/// For a route that only happens to end where it begins: its last pose is moved 3 mm back, and
/// openRoute() takes it for no loop.
void keepOpen(nav_msgs::Path& path);

}  // namespace pilothouse
