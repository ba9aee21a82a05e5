#pragma once

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Odometry.h>
#include <pilothouse/MapGrid.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_ros/transform_listener.h>

#include <optional>
#include <string>

#include "nodelets/pose_settings.hpp"
#include "nodelets/scan_thread.hpp"

namespace pilothouse {

/// What the pose tracker takes in, checked and laid before the tracker and the thread of the scans.
/// Each take() returns why it refused; empty: it did not. One thread at a time.
class PoseInputs {
 public:
  /// What an odometry led to.
  struct Tracked {
    OdometryVerdict verdict = OdometryVerdict::kTaken;
    PoseEstimate estimate;
    Pose2 T_map_odom;
  };

  PoseInputs(const PoseSettings& settings, SharedTracker& shared, ScanThread& thread)
      : settings_(settings), shared_(shared), thread_(thread) {}

  std::string take(const nav_msgs::Odometry& odometry, Tracked& tracked);
  std::string take(const sensor_msgs::Imu& imu);
  /// Set by hand.
  std::string take(const geometry_msgs::PoseWithCovarianceStamped& pose);
  /// @param source index of the scanner.
  std::string take(std::size_t source, const sensor_msgs::LaserScan& scan);
  /// A map given; left aside once one came that tells thresholds from walls.
  std::string take(const nav_msgs::OccupancyGrid& map);
  std::string take(const MapGrid& map);

 private:
  /// Why a frame is not the one expected.
  static std::string wrongFrame(const std::string& frame, const std::string& expected);
  /// Where a sensor sits, newest. @param fault why that is not known
  std::optional<Eigen::Isometry3d> mounting(const std::string& frame, std::string& fault);

  const PoseSettings& settings_;
  SharedTracker& shared_;
  ScanThread& thread_;
  bool cells_came_ = false;
  tf2_ros::Buffer transforms_;
  tf2_ros::TransformListener listener_{transforms_};
};

}  // namespace pilothouse
