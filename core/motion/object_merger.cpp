#include "core/motion/object_merger.hpp"

#include <algorithm>
#include <cmath>

namespace pilothouse {
namespace {

constexpr double kPiece = 0.08;       // discs that an echo's arc is cut into [m]
constexpr double kOldest = 1.0;       // echoes are left out when older [s]
constexpr double kMoved = 0.01;       // [m], [rad]: the memory is told where the robot went
constexpr double kEchoMargin = 0.15;  // an echo clears the cone up to so far before itself [m]
constexpr double kInner = 0.7;        // share of the cone that clears

}  // namespace

ObjectMerger::ObjectMerger(const AvoidanceParameters& parameters, const Footprint& footprint,
                           const std::vector<Ranger>& rangers)
    : parameters_(parameters),
      rangers_(rangers),
      seen_(rangers.size()),
      memory_(parameters, footprint) {
  merged_.sources.push_back({"camera", -1.0});
  for (const auto& ranger : rangers) merged_.sources.push_back({ranger.name, -1.0});
}

void ObjectMerger::setParameters(const AvoidanceParameters& parameters) {
  parameters_ = parameters;
  memory_.setParameters(parameters);
}

void ObjectMerger::clear() {
  poses_.clear();
  memory_.clear();
  floor_stamp_ = -1.0;
  for (auto& seen : seen_) seen = {};
}

bool ObjectMerger::odometry(double stamp, const Pose2& pose, const Twist2& twist) {
  if (!poses_.add(stamp, pose, twist)) return false;
  const bool moved = (pose.position() - driven_to_.position()).norm() > kMoved ||
                     std::abs(wrapped(pose.heading - driven_to_.heading)) > kMoved;
  if (moved) {
    memory_.drivenOver(pose, stamp);
    driven_to_ = pose;
  }
  return true;
}

bool ObjectMerger::floor(const FloorFrame& frame) {
  const auto pose = poses_.at(frame.stamp);
  if (!pose) return false;
  if (floor_stamp_ < 0.0) memory_.drivenOver(*pose, frame.stamp);
  memory_.add(frame, *pose);
  floor_stamp_ = frame.stamp;
  return true;
}

bool ObjectMerger::range(std::size_t ranger, double stamp, const RangeReading& reading) {
  const Eigen::Isometry3d& T_base_ranger = rangers_.at(ranger).T_base_ranger;
  Seen& seen = seen_[ranger];
  if (!(stamp > seen.stamp)) return false;
  if (!objectsOf(reading, T_base_ranger, kPiece, seen.objects)) return false;
  seen.stamp = stamp;
  for (auto& object : seen.objects) object.source = static_cast<std::uint8_t>(ranger + 1);
  const auto pose = poses_.at(stamp);
  const double free = std::min(reading.range, reading.max_range) - kEchoMargin;
  if (!pose || !(free > 0.0)) return true;
  const Eigen::Vector2d at = *pose * T_base_ranger.translation().head<2>();
  const Eigen::Vector3d axis = T_base_ranger.linear() * Eigen::Vector3d::UnitX();
  memory_.seenFree({at.x(), at.y(), pose->heading + std::atan2(axis.y(), axis.x())},
                   0.5 * kInner * reading.field_of_view, free, T_base_ranger.translation().z());
  return true;
}

const Surroundings& ObjectMerger::merge(double now) {
  merged_.stamp = now;
  merged_.objects.clear();
  merged_.sources[0].stamp = floor_stamp_;
  for (std::size_t i = 0; i < seen_.size(); ++i) merged_.sources[i + 1].stamp = seen_[i].stamp;
  const auto pose = poses_.at(now);
  if (!pose) return merged_;
  memory_.collect(*pose, now, merged_.objects);
  for (const auto& seen : seen_) {
    if (seen.stamp < 0.0 || now - seen.stamp > kOldest) continue;
    const auto then = poses_.at(seen.stamp);
    for (Obstacle object : seen.objects) {
      if (then) {
        object.position = pose->toBase(*then * object.position.cast<double>()).cast<float>();
      }
      merged_.objects.push_back(object);
    }
  }
  return merged_;
}

}  // namespace pilothouse
