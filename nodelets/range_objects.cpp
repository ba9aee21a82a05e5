#include <diagnostic_updater/diagnostic_updater.h>
#include <nodelet/nodelet.h>
#include <pilothouse/ObjectList.h>
#include <pluginlib/class_list_macros.hpp>

#include "doors/guarded_subscriber.hpp"
#include "doors/motion_views.hpp"
#include "doors/robot_description.hpp"
#include "nodelets/input_health.hpp"
#include "nodelets/motion_messages.hpp"

namespace pilothouse {

/// Publishes on objects/NAME what each ranger of the robot's file (namespace robot) may have met,
/// from range/NAME, in the robot's base frame.
class RangeObjects : public nodelet::Nodelet {
  struct Ranger {
    Ranger(const RangerOnRobot& ranger, const std::string& topic, double timeout)
        : name(ranger.name), T_base_ranger(rangerPose(ranger)), health(topic, timeout) {}
    std::string name;
    Eigen::Isometry3d T_base_ranger;
    InputHealth health;
    ros::Subscriber input;
    ros::Publisher output;
  };

  void onInit() override {
    double timeout = 1.0;
    StrictParameters own(getPrivateNodeHandle());
    own.read("base_frame", base_frame_);
    own.read("piece", piece_, 0.005, 1.0);
    own.read("input_timeout", timeout, 0.1, 3600.0);
    own.finish();
    ros::NodeHandle& handle = getNodeHandle();
    StrictParameters reader(ros::NodeHandle(handle, "robot"));
    const RobotDescription robot = readRobot(reader);
    diagnostics_ =
        std::make_unique<diagnostic_updater::Updater>(handle, getPrivateNodeHandle(), getName());
    diagnostics_->setHardwareID("none");
    for (const auto& ranger : robot.rangers) add(ranger, timeout);
    diagnostics_timer_ = handle.createWallTimer(
        ros::WallDuration(1.0),
        [this](const ros::WallTimerEvent&) { diagnostics_->force_update(); });
  }

  void add(const RangerOnRobot& description, double timeout) {
    ros::NodeHandle& handle = getNodeHandle();
    const std::string topic = "range/" + description.name;
    rangers_.push_back(std::make_unique<Ranger>(description, handle.resolveName(topic), timeout));
    Ranger& ranger = *rangers_.back();
    ranger.health.listening(true);
    ranger.output = handle.advertise<ObjectList>("objects/" + ranger.name, 2);
    ranger.input = subscribeGuarded<sensor_msgs::Range>(
        handle, topic, 4,
        [this, &ranger](const sensor_msgs::Range::ConstPtr& range) { take(ranger, *range); },
        [&ranger](const std::string& reason) { ranger.health.rejected("lengths", reason); });
    diagnostics_->add(ranger.name, &ranger.health, &InputHealth::report);
  }

  void take(Ranger& ranger, const sensor_msgs::Range& range) {
    const auto begin = InputHealth::Clock::now();
    ranger.health.arrived();
    ranger.health.stamped(ros::Time::now().toSec() - range.header.stamp.toSec());
    const Checked<RangeReading> reading = openReading(range);
    if (!reading) return ranger.health.rejected("message", reading.reason());
    if (!objectsOf(*reading, ranger.T_base_ranger, piece_, objects_)) {
      return ranger.health.rejected("message", "a reading that means nothing");
    }
    std_msgs::Header header = range.header;
    header.frame_id = base_frame_;
    ranger.output.publish(toMessage(header, ranger.name, objects_));
    ranger.health.accepted(InputHealth::Clock::now() - begin);
  }

  std::string base_frame_ = "base_link";
  double piece_ = 0.1;  ///< diameter of the discs that an echo's arc is made of [m]
  std::vector<std::unique_ptr<Ranger>> rangers_;
  std::vector<Obstacle> objects_;
  std::unique_ptr<diagnostic_updater::Updater> diagnostics_;
  ros::WallTimer diagnostics_timer_;
};

}  // namespace pilothouse

PLUGINLIB_EXPORT_CLASS(pilothouse::RangeObjects, nodelet::Nodelet)
