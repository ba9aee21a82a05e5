#include <nodelet/nodelet.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <pluginlib/class_list_macros.hpp>

#include "doors/robot_description.hpp"

namespace pilothouse {

/// Publishes on tf_static where the robot's file (namespace robot) says that the camera and the
/// rangers sit: base_link -> camera_link (its body) -> its optical frame; base_link -> range_NAME.
class RobotFrames : public nodelet::Nodelet {
  void onInit() override {
    StrictParameters own(getPrivateNodeHandle());
    own.read("base_frame", base_frame_);
    own.finish();
    StrictParameters reader(ros::NodeHandle(getNodeHandle(), "robot"));
    const RobotDescription robot = readRobot(reader);
    const CameraOnRobot& camera = robot.camera;
    const std::string body = bodyFrame(camera.frame);
    std::vector<geometry_msgs::TransformStamped> transforms = {
        stamped(base_frame_, body, bodyPose(camera)),
        stamped(body, camera.frame, opticalRotation())};
    for (const auto& ranger : robot.rangers) {
      transforms.push_back(stamped(base_frame_, "range_" + ranger.name, rangerPose(ranger)));
    }
    broadcaster_ = std::make_unique<tf2_ros::StaticTransformBroadcaster>();
    broadcaster_->sendTransform(transforms);
  }

  static geometry_msgs::TransformStamped stamped(const std::string& parent,
                                                 const std::string& child,
                                                 const Eigen::Isometry3d& T_parent_child) {
    geometry_msgs::TransformStamped transform = tf2::eigenToTransform(T_parent_child);
    transform.header.stamp = ros::Time::now();
    transform.header.frame_id = parent;
    transform.child_frame_id = child;
    return transform;
  }

  std::string base_frame_ = "base_link";
  std::unique_ptr<tf2_ros::StaticTransformBroadcaster> broadcaster_;
};

}  // namespace pilothouse

PLUGINLIB_EXPORT_CLASS(pilothouse::RobotFrames, nodelet::Nodelet)
