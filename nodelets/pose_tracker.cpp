#include <diagnostic_updater/diagnostic_updater.h>
#include <nav_msgs/Odometry.h>
#include <nodelet/nodelet.h>
#include <tf2_ros/transform_broadcaster.h>
#include <pluginlib/class_list_macros.hpp>

#include "doors/guarded_subscriber.hpp"
#include "nodelets/input_health.hpp"
#include "nodelets/pose_inputs.hpp"
#include "nodelets/pose_messages.hpp"
#include "nodelets/scan_thread.hpp"
#include "registration/icp_matcher.hpp"

namespace pilothouse {

/// Where the robot is in the map: odom, imu/data (where there is one), scans, initialpose and, with
/// match set to map, map or map_cells in; tf map -> odom and pose out with each odometry.
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
    inputs_ = std::make_unique<PoseInputs>(settings_, *shared_, *thread_);
    pose_ = handle.advertise<geometry_msgs::PoseWithCovarianceStamped>("pose", 4);
    diagnostics_ =
        std::make_unique<diagnostic_updater::Updater>(handle, getPrivateNodeHandle(), getName());
    diagnostics_->setHardwareID("none");
    diagnostics_->add("matches", [this](auto& status) { report(status, thread_->report()); });

    subscribe<nav_msgs::Odometry>("odom", 1.0, [this](const auto& m) { return take(m); });
    subscribe<sensor_msgs::Imu>("imu/data", 1e9,
                                [this](const auto& m) { return inputs_->take(m); });
    subscribe<geometry_msgs::PoseWithCovarianceStamped>("initialpose", 1e9, [this](const auto& m) {
      const std::string fault = inputs_->take(m);
      if (!fault.empty()) NODELET_WARN("initialpose refused: %s", fault.c_str());
      return fault;
    });
    for (std::size_t i = 0; i < settings_.scans.size(); ++i) {
      subscribe<sensor_msgs::LaserScan>(settings_.scans[i], 5.0,
                                        [this, i](const auto& m) { return inputs_->take(i, m); });
    }
    if (settings_.given_map) {
      subscribe<nav_msgs::OccupancyGrid>("map", 1e9,
                                         [this](const auto& m) { return inputs_->take(m); });
      subscribe<MapGrid>("map_cells", 1e9, [this](const auto& m) { return inputs_->take(m); });
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
    PoseInputs::Tracked tracked;
    if (std::string fault = inputs_->take(odometry, tracked); !fault.empty()) return fault;
    if (tracked.verdict == OdometryVerdict::kTimeBack) {
      NODELET_WARN("time ran back to %.3f s: earlier scans and readings are forgotten",
                   odometry.header.stamp.toSec());
      healths_.front()->timeJumped();
    } else if (tracked.verdict == OdometryVerdict::kJumped) {
      NODELET_WARN("odometry jumped: the base began to count anew, the pose in the map stays");
    }
    std_msgs::Header header;
    header.stamp = odometry.header.stamp;
    header.frame_id = settings_.map_frame;
    broadcaster_.sendTransform(toTransform(header, settings_.odom_frame, tracked.T_map_odom));
    pose_.publish(toPose(header, tracked.estimate));
    return {};
  }

  PoseSettings settings_;
  std::unique_ptr<SharedTracker> shared_;
  tf2_ros::TransformBroadcaster broadcaster_;
  ros::Publisher pose_;
  std::vector<std::unique_ptr<InputHealth>> healths_;
  std::unique_ptr<diagnostic_updater::Updater> diagnostics_;
  std::unique_ptr<ScanThread> thread_;
  std::unique_ptr<PoseInputs> inputs_;
  std::vector<ros::Subscriber> subscribers_;
  ros::WallTimer diagnostics_timer_;
};

}  // namespace pilothouse

PLUGINLIB_EXPORT_CLASS(pilothouse::PoseTrackerNodelet, nodelet::Nodelet)
