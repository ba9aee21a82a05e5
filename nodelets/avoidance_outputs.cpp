#include "nodelets/avoidance_outputs.hpp"

#include <geometry_msgs/TwistStamped.h>
#include <pilothouse/ObjectList.h>
#include <pilothouse/SpeedLimit.h>

#include <utility>

#include "nodelets/motion_messages.hpp"

namespace pilothouse {
namespace {

// The limiter's causes are the message's numbers.
static_assert(SpeedLimit::FREE == static_cast<int>(LimitCause::kFree));
static_assert(SpeedLimit::OBSTACLE == static_cast<int>(LimitCause::kObstacle));
static_assert(SpeedLimit::POTENTIAL == static_cast<int>(LimitCause::kPotential));
static_assert(SpeedLimit::BRAKING == static_cast<int>(LimitCause::kBraking));
static_assert(SpeedLimit::THRESHOLD == static_cast<int>(LimitCause::kThreshold));
static_assert(SpeedLimit::UNSEEN == static_cast<int>(LimitCause::kUnseen));
static_assert(SpeedLimit::STALE == static_cast<int>(LimitCause::kStale));
static_assert(SpeedLimit::BAD_COMMAND == static_cast<int>(LimitCause::kBadCommand));

std::string sensorOf(const PathLimit& limit, const AvoidanceStamps& stamps,
                     const Surroundings& surroundings) {
  if (limit.cause == LimitCause::kStale) {
    return stamps.odometry_stale ? "odometry" : stamps.oldest;
  }
  if (limit.remembered) return "memory";
  const auto source = static_cast<std::size_t>(limit.source);
  return limit.source >= 0 && source < surroundings.sources.size()
             ? surroundings.sources[source].name
             : std::string();
}

}  // namespace

AvoidanceOutputs::AvoidanceOutputs(ros::NodeHandle& handle, std::string base_frame)
    : base_frame_(std::move(base_frame)),
      command_(handle.advertise<geometry_msgs::TwistStamped>("cmd_vel/limited", 2)),
      limit_(handle.advertise<SpeedLimit>("speed_limit", 2)),
      merged_(handle.advertise<ObjectList>("objects/merged", 2)),
      filtered_(handle.advertise<ObjectList>("objects/filtered", 2)) {}

void AvoidanceOutputs::publish(double now, const LimitedCommand& limited,
                               const CommandChoice::Wish& wish, const AvoidanceStamps& stamps,
                               const Surroundings& surroundings) {
  geometry_msgs::TwistStamped command;
  command.header.frame_id = base_frame_;
  command.header.stamp = stampOf(wish.stamp);  // the original's: its age is what the gate judges
  command.twist.linear.x = limited.command.vx;
  command.twist.linear.y = limited.command.vy;
  command.twist.angular.z = limited.command.w;
  command_.publish(command);

  const PathLimit& by = limited.limit;
  SpeedLimit limit;
  limit.header.stamp = stampOf(now);
  limit.header.frame_id = base_frame_;
  limit.cause = static_cast<std::uint8_t>(by.cause);
  limit.sensor = sensorOf(by, stamps, surroundings);
  limit.distance = static_cast<float>(by.distance);
  limit.position.x = static_cast<float>(by.position.x());
  limit.position.y = static_cast<float>(by.position.y());
  limit.limit = static_cast<float>(by.speed);
  limit.wanted = static_cast<float>(limited.wanted);
  limit.limited = static_cast<float>(limited.limited);
  limit.measured = static_cast<float>(limited.measured);
  limit.obstacle_distance = static_cast<float>(by.obstacle_distance);
  limit.potential_distance = static_cast<float>(by.potential_distance);
  limit.source = wish.source;
  limit.perception_stamp = stampOf(stamps.perception);
  limit.odometry_stamp = stampOf(stamps.odometry);
  limit.command_stamp = stampOf(wish.stamp);
  limit_.publish(limit);
}

void AvoidanceOutputs::publish(const Surroundings& surroundings) {
  std_msgs::Header header;
  header.stamp = stampOf(surroundings.stamp);
  header.frame_id = base_frame_;
  if (merged_.getNumSubscribers() > 0) merged_.publish(toMessage(header, "merged", surroundings));
  if (filtered_.getNumSubscribers() > 0) {
    filtered_.publish(toMessage(header, "filtered", surroundings));
  }
}

}  // namespace pilothouse
