#include "nodelets/base_pose.hpp"

#include <chrono>
#include <cstdio>

#include "doors/goal_views.hpp"
#include "doors/motion_views.hpp"

namespace pilothouse {
namespace {

constexpr double kOldestOdometry = 0.5;   // since it came in [s]
constexpr double kOldestTransform = 1.0;  // since its stamp [s]

double steadyNow() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::string tooOld(const std::string& what, double age) {
  char text[48];
  std::snprintf(text, sizeof text, " is %.1f s old", age);
  return what + text;
}

}  // namespace

std::string BasePose::take(const nav_msgs::Odometry& odometry) {
  const auto motion = openOdometry(odometry);
  if (!motion) return motion.reason();
  if (odometry.header.frame_id != odom_frame_) return "in another frame than " + odom_frame_;
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
    fault = "frame \"" + from.substr(0, 64) + "\": " + unknown.what();
  }
  return std::nullopt;
}

std::optional<Pose2> BasePose::in(const std::string& frame, std::string& fault) const {
  if (!T_odom_base_) {
    fault = "no odometry has come";
    return std::nullopt;
  }
  const double age = steadyNow() - arrival_;
  if (age > kOldestOdometry) {
    fault = tooOld("odometry", age);
    return std::nullopt;
  }
  const auto T_frame_odom = transform(frame, odom_frame_, fault);
  if (!T_frame_odom) return std::nullopt;
  if (frame != odom_frame_) {
    const ros::Time stamp =
        transforms_.lookupTransform(frame, odom_frame_, ros::Time(0)).header.stamp;
    const double old = stamp.isZero() ? 0.0 : (ros::Time::now() - stamp).toSec();  // zero: static
    if (old > kOldestTransform) {
      fault = tooOld("the transform from " + odom_frame_ + " to " + frame, old);
      return std::nullopt;
    }
  }
  const Eigen::Vector2d place = *T_frame_odom * T_odom_base_->position();
  return Pose2{place.x(), place.y(), wrapped(T_frame_odom->heading + T_odom_base_->heading)};
}

}  // namespace pilothouse
