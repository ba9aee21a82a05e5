#include "nodelets/pose_inputs.hpp"

#include <tf2_eigen/tf2_eigen.h>

#include "doors/map_views.hpp"
#include "doors/motion_views.hpp"
#include "doors/scan_views.hpp"
#include "nodelets/pose_messages.hpp"

namespace pilothouse {

std::string PoseInputs::wrongFrame(const std::string& frame, const std::string& expected) {
  return "frame is \"" + frame.substr(0, 64) + "\", expected \"" + expected + "\"";
}

std::string PoseInputs::take(const nav_msgs::Odometry& odometry, Tracked& tracked) {
  const auto motion = openOdometry(odometry);
  if (!motion) return motion.reason();
  if (odometry.header.frame_id != settings_.odom_frame) {
    return wrongFrame(odometry.header.frame_id, settings_.odom_frame);
  }
  {
    std::lock_guard<std::mutex> lock(shared_.mutex);
    tracked.verdict = shared_.tracker.addOdometry(odometry.header.stamp.toSec(), motion->pose);
    if (tracked.verdict == OdometryVerdict::kNotFinite) {
      return "the pose or the stamp is not finite";
    }
    if (tracked.verdict == OdometryVerdict::kOld) return "not newer than the odometry before";
    tracked.estimate = shared_.tracker.newest();
    tracked.T_map_odom = shared_.tracker.correction();
  }
  thread_.wake();
  return {};
}

std::string PoseInputs::take(const sensor_msgs::Imu& imu) {
  const auto& rate = imu.angular_velocity;
  const Eigen::Vector3d measured(rate.x, rate.y, rate.z);
  if (!measured.allFinite()) return "angular_velocity is not finite";
  std::string fault;
  const auto T_base_imu = mounting(imu.header.frame_id, fault);
  if (!T_base_imu) return fault;
  const double about_vertical = (T_base_imu->linear() * measured).z();
  std::lock_guard<std::mutex> lock(shared_.mutex);
  return shared_.tracker.addGyro(imu.header.stamp.toSec(), about_vertical)
             ? ""
             : "not newer than the reading before";
}

std::string PoseInputs::take(const geometry_msgs::PoseWithCovarianceStamped& pose) {
  if (pose.header.frame_id != settings_.map_frame) {
    return wrongFrame(pose.header.frame_id, settings_.map_frame);
  }
  const auto estimate = openPose(pose);
  if (!estimate) return estimate.reason();
  std::lock_guard<std::mutex> lock(shared_.mutex);
  return shared_.tracker.setPose(*estimate).value_or("");
}

std::string PoseInputs::take(std::size_t source, const sensor_msgs::LaserScan& scan) {
  const auto beams = openScan(scan);
  if (!beams) return beams.reason();
  std::string fault;
  const auto T_base_scanner = mounting(scan.header.frame_id, fault);
  if (!T_base_scanner) return fault;
  const auto level = levelMounting(*T_base_scanner);
  if (!level) return "the scanner is not level";
  thread_.take(source, settings_.stamped_at_end ? stampedAtBegin(*beams) : *beams, *level);
  return {};
}

std::string PoseInputs::take(const nav_msgs::OccupancyGrid& map) {
  if (map.header.frame_id != settings_.map_frame) {
    return wrongFrame(map.header.frame_id, settings_.map_frame);
  }
  if (cells_came_) return {};
  auto cells = openMap(map);
  if (!cells) return cells.reason();
  thread_.give(*cells);
  return {};
}

std::string PoseInputs::take(const MapGrid& map) {
  if (map.header.frame_id != settings_.map_frame) {
    return wrongFrame(map.header.frame_id, settings_.map_frame);
  }
  auto cells = openMap(map);
  if (!cells) return cells.reason();
  cells_came_ = true;
  thread_.give(*cells);
  return {};
}

std::optional<Eigen::Isometry3d> PoseInputs::mounting(const std::string& frame,
                                                      std::string& fault) {
  if (frame == settings_.base_frame) return Eigen::Isometry3d::Identity();
  try {
    return tf2::transformToEigen(
        transforms_.lookupTransform(settings_.base_frame, frame, ros::Time(0)));
  } catch (const tf2::TransformException& unknown) {
    fault = "frame \"" + frame.substr(0, 64) + "\": " + unknown.what();
    return std::nullopt;
  }
}

}  // namespace pilothouse
