#include <diagnostic_updater/diagnostic_updater.h>
#include <nav_msgs/Odometry.h>
#include <nodelet/nodelet.h>
#include <sensor_msgs/Imu.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_ros/transform_broadcaster.h>
#include <tf2_ros/transform_listener.h>
#include <pluginlib/class_list_macros.hpp>

#include "doors/guarded_subscriber.hpp"
#include "doors/motion_views.hpp"
#include "doors/scan_views.hpp"
#include "nodelets/input_health.hpp"
#include "nodelets/pose_messages.hpp"
#include "nodelets/pose_settings.hpp"
#include "nodelets/scan_thread.hpp"
#include "registration/icp_matcher.hpp"

namespace pilothouse {

/// Where the robot is in the map: odom, imu/data (where there is one), scans, initialpose and, with
/// match set to map, map in; tf map -> odom and pose out with each odometry.
class PoseTrackerNodelet : public nodelet::Nodelet {
  void onInit() override {
    ros::NodeHandle& handle = getNodeHandle();
    settings_ = readPoseSettings(getPrivateNodeHandle());
    shared_ = std::make_unique<SharedTracker>(settings_.tracker);
    std::vector<std::unique_ptr<ScanLocaliser>> localisers;
    for (std::size_t i = 0; i < settings_.scans.size(); ++i) {
      localisers.push_back(std::make_unique<ScanLocaliser>(
          settings_.localiser, std::make_unique<IcpMatcher>(settings_.icp)));
      if (settings_.given_map) localisers.back()->give({});
    }
    thread_ = std::make_unique<ScanThread>(*shared_, std::move(localisers));
    pose_ = handle.advertise<geometry_msgs::PoseWithCovarianceStamped>("pose", 4);
    diagnostics_ =
        std::make_unique<diagnostic_updater::Updater>(handle, getPrivateNodeHandle(), getName());
    diagnostics_->setHardwareID("none");
    diagnostics_->add("matches", [this](auto& status) { report(status, thread_->report()); });

    subscribe<nav_msgs::Odometry>("odom", 1.0, [this](const auto& m) { return take(m); });
    subscribe<sensor_msgs::Imu>("imu/data", 1e9, [this](const auto& m) { return take(m); });
    subscribe<geometry_msgs::PoseWithCovarianceStamped>("initialpose", 1e9, [this](const auto& m) {
      const std::string fault = take(m);
      if (!fault.empty()) NODELET_WARN("initialpose refused: %s", fault.c_str());
      return fault;
    });
    for (std::size_t i = 0; i < settings_.scans.size(); ++i) {
      subscribe<sensor_msgs::LaserScan>(settings_.scans[i], 5.0,
                                        [this, i](const auto& m) { return take(i, m); });
    }
    if (settings_.given_map) {
      subscribe<nav_msgs::OccupancyGrid>("map", 1e9, [this](const auto& m) { return take(m); });
    }
    diagnostics_timer_ = handle.createWallTimer(
        ros::WallDuration(1.0),
        [this](const ros::WallTimerEvent&) { diagnostics_->force_update(); });
  }

  template <class Message>
  void subscribe(const std::string& topic, double timeout,
                 std::function<std::string(const Message&)> take) {
    healths_.push_back(std::make_unique<InputHealth>(topic, timeout));
    InputHealth& health = *healths_.back();
    health.listening(true);
    diagnostics_->add(topic, &health, &InputHealth::report);
    subscribers_.push_back(subscribeGuarded<Message>(
        getNodeHandle(), topic, 32,
        [&health, take](const boost::shared_ptr<const Message>& message) {
          const auto begin = InputHealth::Clock::now();
          health.arrived();
          const std::string fault = take(*message);
          if (fault.empty()) return health.accepted(InputHealth::Clock::now() - begin);
          health.rejected("message", fault);
        },
        [&health](const std::string& reason) { health.rejected("lengths", reason); },
        ros::TransportHints().tcpNoDelay()));
  }

  std::string take(const nav_msgs::Odometry& odometry) {
    const auto motion = openOdometry(odometry);
    if (!motion) return motion.reason();
    if (odometry.header.frame_id != settings_.odom_frame) {
      return "frame is \"" + odometry.header.frame_id.substr(0, 64) + "\", expected \"" +
             settings_.odom_frame + "\"";
    }
    PoseEstimate estimate;
    Pose2 T_map_odom;
    auto verdict = OdometryVerdict::kTaken;
    {
      std::lock_guard<std::mutex> lock(shared_->mutex);
      verdict = shared_->tracker.addOdometry(odometry.header.stamp.toSec(), motion->pose);
      if (verdict == OdometryVerdict::kNotFinite) return "the pose or the stamp is not finite";
      if (verdict == OdometryVerdict::kOld) return "not newer than the odometry before";
      estimate = shared_->tracker.newest();
      T_map_odom = shared_->tracker.correction();
    }
    if (verdict == OdometryVerdict::kTimeBack) {
      NODELET_WARN("time ran back to %.3f s: earlier scans and readings are forgotten",
                   odometry.header.stamp.toSec());
      healths_.front()->timeJumped();
    } else if (verdict == OdometryVerdict::kJumped) {
      NODELET_WARN("odometry jumped: the base began to count anew, the pose in the map stays");
    }
    thread_->wake();
    std_msgs::Header header;
    header.stamp = odometry.header.stamp;
    header.frame_id = settings_.map_frame;
    broadcaster_.sendTransform(toTransform(header, settings_.odom_frame, T_map_odom));
    pose_.publish(toPose(header, estimate));
    return {};
  }

  std::string take(const sensor_msgs::Imu& imu) {
    const auto& rate = imu.angular_velocity;
    const Eigen::Vector3d measured(rate.x, rate.y, rate.z);
    if (!measured.allFinite()) return "angular_velocity is not finite";
    std::string fault;
    const auto T_base_imu = mounting(imu.header.frame_id, fault);
    if (!T_base_imu) return fault;
    const double about_vertical = (T_base_imu->linear() * measured).z();
    std::lock_guard<std::mutex> lock(shared_->mutex);
    return shared_->tracker.addGyro(imu.header.stamp.toSec(), about_vertical)
               ? ""
               : "not newer than the reading before";
  }

  std::string take(const geometry_msgs::PoseWithCovarianceStamped& pose) {
    if (pose.header.frame_id != settings_.map_frame) {
      return "frame is \"" + pose.header.frame_id.substr(0, 64) + "\", expected \"" +
             settings_.map_frame + "\"";
    }
    const auto estimate = openPose(pose);
    if (!estimate) return estimate.reason();
    std::lock_guard<std::mutex> lock(shared_->mutex);
    return shared_->tracker.setPose(*estimate).value_or("");
  }

  std::string take(std::size_t source, const sensor_msgs::LaserScan& scan) {
    const auto beams = openScan(scan);
    if (!beams) return beams.reason();
    std::string fault;
    const auto T_base_scanner = mounting(scan.header.frame_id, fault);
    if (!T_base_scanner) return fault;
    const auto level = levelMounting(*T_base_scanner);
    if (!level) return "the scanner is not level";
    thread_->take(source, settings_.stamped_at_end ? stampedAtBegin(*beams) : *beams, *level);
    return {};
  }

  std::string take(const nav_msgs::OccupancyGrid& map) {
    if (map.header.frame_id != settings_.map_frame) {
      return "frame is \"" + map.header.frame_id.substr(0, 64) + "\", expected \"" +
             settings_.map_frame + "\"";
    }
    auto cells = openMap(map);
    if (!cells) return cells.reason();
    thread_->give(*cells);
    return {};
  }

  /// Where a sensor sits, newest. @param fault why that is not known
  std::optional<Eigen::Isometry3d> mounting(const std::string& frame, std::string& fault) {
    if (frame == settings_.base_frame) return Eigen::Isometry3d::Identity();
    try {
      return tf2::transformToEigen(
          transforms_.lookupTransform(settings_.base_frame, frame, ros::Time(0)));
    } catch (const tf2::TransformException& unknown) {
      fault = "frame \"" + frame.substr(0, 64) + "\": " + unknown.what();
      return std::nullopt;
    }
  }

  PoseSettings settings_;
  std::unique_ptr<SharedTracker> shared_;
  tf2_ros::Buffer transforms_;
  tf2_ros::TransformListener listener_{transforms_};
  tf2_ros::TransformBroadcaster broadcaster_;
  ros::Publisher pose_;
  std::vector<std::unique_ptr<InputHealth>> healths_;
  std::unique_ptr<diagnostic_updater::Updater> diagnostics_;
  std::unique_ptr<ScanThread> thread_;
  std::vector<ros::Subscriber> subscribers_;
  ros::WallTimer diagnostics_timer_;
};

}  // namespace pilothouse

PLUGINLIB_EXPORT_CLASS(pilothouse::PoseTrackerNodelet, nodelet::Nodelet)
