#include "sim/actor_path.hpp"

#include <algorithm>
#include <cmath>

namespace pilothouse::sim {

Pose2 poseAt(const ActorPath& path, double time) {
  const auto& points = path.points;
  const double first = points.front().time, last = points.back().time;
  if (path.loop && last > first && time > last) {
    time = first + std::fmod(time - first, last - first);
  }
  const auto next =
      std::find_if(points.begin(), points.end(), [&](const auto& p) { return p.time > time; });
  if (next == points.begin()) return points.front().pose;
  if (next == points.end()) return points.back().pose;
  const auto& from = *(next - 1);
  const double share = (time - from.time) / (next->time - from.time);
  const Pose2 &a = from.pose, &b = next->pose;
  return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y),
          wrapped(a.heading + share * wrapped(b.heading - a.heading))};
}

Eigen::Isometry3d actorPose(const Model& actor, const Pose2& pose) {
  Eigen::Isometry3d T_world_model = Eigen::Isometry3d::Identity();
  T_world_model.translation() << pose.x, pose.y, actor.T_world_model.translation().z();
  T_world_model.linear() =
      Eigen::AngleAxisd(pose.heading, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return T_world_model;
}

}  // namespace pilothouse::sim
