#include "sim/ground_support.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace pilothouse::sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kClimb = kDropHeight + 0.01;  ///< ground is looked for this much above [m]
/// A slit's edges are this near to the middle of a wheel that it carries, in radii: half its width
/// at most, and so narrow that the wheel does not sink in.
constexpr double kBridged = 0.15;
/// Where along its tread a wheel is tried against the ground, in radii.
constexpr std::array<double, 5> kTread = {-0.9, -0.5, 0.0, 0.5, 0.9};

/// Height of the robot's plane over a point of the world.
double planeHeight(const Eigen::Isometry3d& T_world_base, const Vector2d& point) {
  const Vector3d normal = T_world_base.linear().col(2);
  const Vector3d& origin = T_world_base.translation();
  return origin.z() -
         (normal.x() * (point.x() - origin.x()) + normal.y() * (point.y() - origin.y())) /
             normal.z();
}

/// Where the wheel's lowest point comes to rest: its round tread lies on the highest ground.
double restingHeight(const WorldScene& scene, const Vector2d& at, const Vector2d& rolling,
                     double radius, double from_z, double under) {
  double highest = under;
  for (const double share : kTread) {
    if (share == 0.0) continue;
    const auto ground = scene.groundBelow(at + share * radius * rolling, from_z);
    if (!ground) continue;
    highest = std::max(highest, *ground + radius * (std::sqrt(1.0 - share * share) - 1.0));
  }
  return highest;
}

/// The ground under a wheel, or castor: a slit narrower than itself is bridged, however deep.
/// @return nothing where there is none above `lowest`.
std::optional<double> groundUnder(const WorldScene& scene, const Vector2d& at,
                                  const Vector2d& rolling, double radius, double from_z,
                                  double lowest) {
  const auto held = [&](const Vector2d& aside) {
    auto ground = scene.groundBelow(at + aside, from_z);
    if (ground && *ground < lowest) ground.reset();
    return ground;
  };
  auto ground = held(Vector2d::Zero());
  // Along the tread, then across it.
  for (const Vector2d& reach :
       {Vector2d(kBridged * radius * rolling),
        Vector2d(kBridged * radius * Vector2d(-rolling.y(), rolling.x()))}) {
    if (ground) break;
    const auto before = held(-reach), behind = held(reach);
    if (before && behind) ground = std::min(*before, *behind);
  }
  return ground;
}

}  // namespace

GroundSupport::GroundSupport(const SimRobot& robot) : radius_(robot.base.wheel_radius) {
  const Kinematics kinematics(robot.base);
  for (std::size_t i = 0; i < kinematics.wheels().size(); ++i) {
    feet_.push_back({kinematics.wheels()[i].position, static_cast<int>(i)});
  }
  if (robot.base.kind == BaseKind::kDifferential) {
    double reach = 0.0;
    for (const auto& corner : robot.footprint.corners()) {
      reach = std::max(reach, std::abs(corner.x()));
    }
    feet_.push_back({{0.7 * reach, 0.0}, -1});
    feet_.push_back({{-0.7 * reach, 0.0}, -1});
  }
}

Stance GroundSupport::putDown(const WorldScene& scene, const Pose2& pose, double from_z) const {
  Stance stance;
  heights_.clear();
  for (const Foot& foot : feet_) {
    const Vector2d forward(std::cos(pose.heading), std::sin(pose.heading));
    const auto ground = groundUnder(scene, pose * foot.at, forward, radius_, from_z,
                                    -std::numeric_limits<double>::infinity());
    stance.drop = stance.drop || !ground;
    heights_.push_back(ground.value_or(0.0));
  }
  stance.T_world_base = planeThrough(pose, heights_);
  return stance;
}

Stance GroundSupport::moveOn(const WorldScene& scene, const Pose2& pose, const Stance& before,
                             const WheelStates& wheels) const {
  Stance stance;
  heights_.clear();
  for (const Foot& foot : feet_) {
    const Vector2d at = pose * foot.at;
    const double expected = planeHeight(before.T_world_base, at);
    const double angle =
        pose.heading + (foot.wheel >= 0 ? wheels[static_cast<std::size_t>(foot.wheel)].angle : 0.0);
    const Vector2d rolling(std::cos(angle), std::sin(angle));
    const auto ground =
        groundUnder(scene, at, rolling, radius_, expected + kClimb, expected - kDropHeight);
    if (!ground) {
      stance.drop = true;
      heights_.push_back(expected);
      continue;
    }
    heights_.push_back(restingHeight(scene, at, rolling, radius_, expected + kClimb, *ground));
  }
  stance.T_world_base = planeThrough(pose, heights_);
  return stance;
}

/// Least squares; the feet lie evenly round the origin, so that the slopes part.
Eigen::Isometry3d GroundSupport::planeThrough(const Pose2& pose,
                                              const std::vector<double>& heights) const {
  double z = 0.0, xz = 0.0, yz = 0.0, xx = 0.0, yy = 0.0;
  for (std::size_t i = 0; i < feet_.size(); ++i) {
    const Vector2d& p = feet_[i].at;
    z += heights[i];
    xz += p.x() * heights[i];
    yz += p.y() * heights[i];
    xx += p.x() * p.x();
    yy += p.y() * p.y();
  }
  const Vector3d forward = Vector3d(1.0, 0.0, xz / xx).normalized();
  const Vector3d up = Vector3d(-xz / xx, -yz / yy, 1.0).normalized();
  Eigen::Matrix3d R_heading_base;
  R_heading_base << forward, up.cross(forward), up;
  Eigen::Isometry3d T_world_base = Eigen::Isometry3d::Identity();
  T_world_base.translation() << pose.x, pose.y, z / static_cast<double>(feet_.size());
  T_world_base.linear() =
      Eigen::AngleAxisd(pose.heading, Vector3d::UnitZ()).toRotationMatrix() * R_heading_base;
  return T_world_base;
}

}  // namespace pilothouse::sim
