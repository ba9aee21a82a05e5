#include "nodelets/base_pose.hpp"

#include <cstdio>

#include "doors/goal_views.hpp"
#include "doors/motion_views.hpp"
#include "doors/steady_clock.hpp"

namespace pilothouse {
namespace {

constexpr double kJitter = 0.1;  // time that goes back by more has jumped [s]

std::string tooOld(const std::string& what, double age, double limit) {
  char text[48];
  std::snprintf(text, sizeof text, " is %.1f s old, limit %.1f s", age, limit);
  return what + text;
}

/// A name from outside, which may be long.
std::string quoted(const std::string& name) {
  return '"' + name.substr(0, 64) + '"';
}

Pose2 product(const Pose2& T_a_b, const Pose2& T_b_c) {
  const Eigen::Vector2d place = T_a_b * T_b_c.position();
  return {place.x(), place.y(), wrapped(T_a_b.heading + T_b_c.heading)};
}

}  // namespace

std::string BasePose::take(const nav_msgs::Odometry& odometry) {
  const auto motion = openOdometry(odometry);
  if (!motion) return motion.reason();
  if (odometry.header.frame_id != odom_frame_) return "in another frame than " + odom_frame_;
  const double stamp = odometry.header.stamp.toSec();
  const auto newest = history_.newest();
  if (newest && stamp + kJitter < *newest) history_.clear();
  history_.add(stamp, motion->pose, motion->twist);
  T_odom_base_ = motion->pose;
  arrival_ = steadyNow();
  return {};
}

std::optional<Pose2> BasePose::transform(const std::string& frame, const std::string& from,
                                         std::string& fault) const {
  if (frame == from) return Pose2{};
  try {
    const auto found = transforms_.lookupTransform(frame, from, ros::Time(0));
    const auto pose = openTransform(found);
    if (pose) return *pose;
    fault = pose.reason();
  } catch (const tf2::TransformException& unknown) {
    const std::string& asked = from == odom_frame_ ? frame : from;
    fault = "frame " + quoted(asked) + ": " + unknown.what();
  }
  return std::nullopt;
}

/// The newest: a frame that is corrected now and then must be right now.
std::optional<Pose2> BasePose::T_frame_odom(const std::string& frame, std::string& fault) const {
  const auto pose = transform(frame, odom_frame_, fault);
  if (!pose || frame == odom_frame_) return pose;
  const ros::Time stamp =
      transforms_.lookupTransform(frame, odom_frame_, ros::Time(0)).header.stamp;
  if (stamp.isZero()) return pose;  // it never changes
  const double age = (ros::Time::now() - stamp).toSec();
  if (age <= limits_.transform) return pose;
  fault = tooOld("transform from " + quoted(odom_frame_) + " to " + quoted(frame), age,
                 limits_.transform);
  return std::nullopt;
}

std::optional<Pose2> BasePose::in(const std::string& frame, std::string& fault) const {
  if (!T_odom_base_) {
    fault = "the robot's pose is not known: no odometry";
    return std::nullopt;
  }
  const double age = steadyNow() - arrival_;
  if (age > limits_.odometry) {
    fault = tooOld("odometry", age, limits_.odometry);
    return std::nullopt;
  }
  const auto T = T_frame_odom(frame, fault);
  if (!T) return std::nullopt;
  return product(*T, *T_odom_base_);
}

std::optional<Pose2> BasePose::at(double stamp, const std::string& frame,
                                  std::string& fault) const {
  const auto then = history_.at(stamp);
  if (!then) {
    fault = "odometry tells nothing of that time";
    return std::nullopt;
  }
  const auto T = T_frame_odom(frame, fault);
  if (!T) return std::nullopt;
  return product(*T, *then);
}

}  // namespace pilothouse
