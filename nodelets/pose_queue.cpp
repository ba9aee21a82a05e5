#include "nodelets/pose_queue.hpp"

#include <cmath>

namespace pilothouse {
namespace {

constexpr std::size_t kMost = 32;  // frames that wait
constexpr double kPatience = 1.0;  // [s]

}  // namespace

std::optional<Pose2> PoseQueue::poseAt(const ros::Time& stamp, std::string& fault) {
  if (!transforms_.canTransform(map_frame_, base_frame_, stamp, &fault)) return std::nullopt;
  try {
    const auto found = transforms_.lookupTransform(map_frame_, base_frame_, stamp).transform;
    const auto& q = found.rotation;
    const Pose2 pose{
        found.translation.x, found.translation.y,
        std::atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z))};
    if (pose.finite()) return pose;
    fault = "the pose is not finite";
  } catch (const tf2::TransformException& error) {
    fault = error.what();
  }
  return std::nullopt;
}

void PoseQueue::add(const ros::Time& stamp, InputHealth& health, Use use) {
  if (waiting_.size() >= kMost) {
    waiting_.front().health->rejected("pose", "too many frames wait for the robot's pose");
    waiting_.pop_front();
  }
  waiting_.push_back({stamp, InputHealth::Clock::now(), &health, std::move(use)});
}

void PoseQueue::work() {
  while (!waiting_.empty()) {
    const Waiting& first = waiting_.front();
    const auto begin = InputHealth::Clock::now();
    std::string fault;
    const auto pose = poseAt(first.stamp, fault);
    const double waited = std::chrono::duration<double>(begin - first.arrival).count();
    if (!pose && waited < kPatience) return;
    if (!pose) {
      first.health->rejected(
          "pose", "the robot's pose in " + map_frame_ + " is not known at its stamp: " + fault);
    } else {
      const std::string refused = first.use(*pose);
      if (refused.empty()) first.health->accepted(InputHealth::Clock::now() - begin);
      if (!refused.empty()) first.health->rejected("message", refused);
    }
    waiting_.pop_front();
  }
}

}  // namespace pilothouse
