#include "nodelets/camera_mounting.hpp"

#include <tf2_eigen/tf2_eigen.h>

namespace pilothouse {

Checked<Eigen::Isometry3f> CameraMounting::find(const std_msgs::Header& header) {
  using Answer = Checked<Eigen::Isometry3f>;
  // tf2 refuses the leading slash that recordings of the tf1 days carry.
  const bool slash = !header.frame_id.empty() && header.frame_id.front() == '/';
  const std::string frame = slash ? header.frame_id.substr(1) : header.frame_id;
  const std::string names = "no transform from \"" + frame + "\" to \"" + base_frame_ + "\": ";
  if (frame.empty()) return Answer::refused(names + "the message's frame_id is empty");
  geometry_msgs::TransformStamped found;
  try {
    try {
      found = buffer_.lookupTransform(base_frame_, frame, header.stamp);
    } catch (const tf2::ExtrapolationException&) {
      found = buffer_.lookupTransform(base_frame_, frame, ros::Time(0));
      ++out_of_time_;
    }
  } catch (const tf2::TransformException& fault) {
    return Answer::refused(names + fault.what());
  }
  const Eigen::Isometry3f T_base_camera = tf2::transformToEigen(found.transform).cast<float>();
  if (!T_base_camera.matrix().allFinite()) return Answer::refused(names + "it is not finite");
  return Answer::of(T_base_camera);
}

}  // namespace pilothouse
