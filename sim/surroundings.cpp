#include "sim/surroundings.hpp"

#include <algorithm>
#include <cmath>

namespace pilothouse::sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

const float kGroundSlope = std::cos(30.0F * 3.14159265F / 180.0F);
constexpr double kTouch = 1e-4;  ///< a sweep ends this near [m]

bool isGround(const WorldScene::SolidTriangle& triangle) {
  const auto& c = triangle.corners;
  const Eigen::Vector3f normal = (c[1] - c[0]).cross(c[2] - c[0]);
  return normal.z() > kGroundSlope * normal.norm();
}

/// Speed of the footprint's fastest corner.
double fastest(const Footprint& footprint, const Twist2& twist) {
  double speed = 0.0;
  for (const auto& p : footprint.corners()) {
    speed = std::max(speed, std::hypot(twist.vx - twist.w * p.y(), twist.vy + twist.w * p.x()));
  }
  return speed;
}

/// Whether moving on from `pose` by `twist` leaves a thing that is touched already.
bool parts(const Footprint& footprint, const Pose2& pose, const Twist2& twist, double speed,
           const Slice& slice, double distance) {
  const Pose2 next = advanced(pose, twist, kTouch / speed);
  return separation(footprint, next, slice) >= distance;
}

}  // namespace

void Surroundings::collect(const WorldScene& scene, const SimRobot& robot,
                           const Eigen::Isometry3d& T_world_base, double reach) {
  near_.clear();
  Eigen::AlignedBox3d box;
  for (const auto& corner : robot.footprint.corners()) {
    box.extend(T_world_base * Vector3d(corner.x(), corner.y(), 0.0));
    box.extend(T_world_base * Vector3d(corner.x(), corner.y(), robot.height));
  }
  const Vector3d margin = Vector3d::Constant(reach);
  const Eigen::AlignedBox3f wide((box.min() - margin).cast<float>(),
                                 (box.max() + margin).cast<float>());
  const Eigen::Isometry3d T_base_world = T_world_base.inverse();
  scene.forEachSolidTriangle(wide, [&](const WorldScene::SolidTriangle& triangle) {
    if (isGround(triangle)) return;
    std::array<Vector3d, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      corners[i] = T_base_world * triangle.corners[i].cast<double>();
    }
    const auto slice = sliceOf(corners, kGroundClearance, robot.height);
    if (slice) near_.push_back({triangle.model, *slice});
  });
}

FreeWay Surroundings::nearest(const Footprint& footprint, const Pose2& pose) const {
  FreeWay way;
  for (const Near& near : near_) {
    const double distance = separation(footprint, pose, near.slice);
    if (distance < way.distance) way = {distance, near.model};
  }
  return way;
}

/// Conservative advancement (Mirtich 1996): no point of the footprint moves farther than the way
/// that is surely free.
FreeWay Surroundings::along(const Footprint& footprint, const Twist2& twist,
                            double farthest) const {
  const double speed = fastest(footprint, twist);
  if (!(speed > 0.0)) return {};
  FreeWay way;
  for (const Near& near : near_) {
    double gone = 0.0;
    const double most = std::min(farthest, way.distance);
    while (gone < most) {
      const Pose2 pose = advanced({}, twist, gone / speed);
      const double distance = separation(footprint, pose, near.slice);
      if (distance > kTouch) {
        gone += distance;
      } else if (parts(footprint, pose, twist, speed, near.slice, distance)) {
        gone += kTouch;
      } else {
        way = {gone, near.model};
        break;
      }
    }
  }
  return way;
}

}  // namespace pilothouse::sim
