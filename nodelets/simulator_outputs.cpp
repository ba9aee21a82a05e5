#include "nodelets/simulator_outputs.hpp"

#include <utility>

#include "nodelets/simulator_messages.hpp"

namespace pilothouse {
namespace {

const std::string kWorld = "world", kOdometry = "odom", kBase = "base_link";
constexpr double kContactPeriod = 0.1;  // [s]

}  // namespace

SimulatorOutputs::SimulatorOutputs(ros::NodeHandle& handle, const sim::SimRobot& robot,
                                   const sim::SensorParameters& parameters,
                                   std::string camera_frame, const Pose2& start)
    : robot_(robot),
      parameters_(parameters),
      kinematics_(robot.base),
      camera_frame_(std::move(camera_frame)),
      depth_(handle.advertise<sensor_msgs::Image>("camera/depth/image_rect", 2)),
      depth_info_(handle.advertise<sensor_msgs::CameraInfo>("camera/depth/camera_info", 2)),
      colour_(handle.advertise<sensor_msgs::Image>("camera/rgb/image_rect_color", 2)),
      colour_info_(handle.advertise<sensor_msgs::CameraInfo>("camera/rgb/camera_info", 2)),
      odometry_(handle.advertise<nav_msgs::Odometry>("odom", 10)),
      imu_(handle.advertise<sensor_msgs::Imu>("imu/data", 10)),
      joints_(handle.advertise<sensor_msgs::JointState>("joint_states", 10)),
      truth_(handle.advertise<nav_msgs::Odometry>("ground_truth", 10)),
      contacts_(handle.advertise<Contacts>("contacts", 10)) {
  for (const auto& ranger : robot_.rangers) {
    ranges_.push_back(handle.advertise<sensor_msgs::Range>("range/" + ranger.name, 10));
  }
  fixed_transforms_.sendTransform(transformOf(start, header(ros::Time::now(), kWorld), kOdometry));
}

std_msgs::Header SimulatorOutputs::header(const ros::Time& stamp, const std::string& frame) {
  std_msgs::Header header;
  header.stamp = stamp;
  header.frame_id = frame;
  return header;
}

void SimulatorOutputs::publish(const sim::Simulation& simulation, const sim::Readings& readings,
                               const Stamp& stamp) {
  if (readings.odometry) {
    const auto odometry = header(stamp(readings.odometry->stamp), kOdometry);
    odometry_.publish(toMessage(readings.odometry->value, odometry, kBase));
    transforms_.sendTransform(transformOf(readings.odometry->value.pose, odometry, kBase));
  }
  if (readings.imu) {
    imu_.publish(
        toMessage(readings.imu->value, parameters_.imu, header(stamp(readings.imu->stamp), kBase)));
  }
  if (readings.joints) {
    joints_.publish(toMessage(readings.joints->value, kinematics_, robot_.base.wheel_radius,
                              header(stamp(readings.joints->stamp), kBase)));
    truth_.publish(truthOf(simulation.base(), header(stamp(readings.time), kWorld), kBase));
  }
  for (std::size_t i = 0; i < readings.ranges.size(); ++i) {
    const auto& range = readings.ranges[i];
    if (!range) continue;
    const auto& ranger = robot_.rangers[i];
    ranges_[i].publish(
        toMessage(range->value, ranger, header(stamp(range->stamp), "range_" + ranger.name)));
  }
  publishContacts(simulation, readings, stamp(readings.time));
  publishPictures(readings, stamp);
}

void SimulatorOutputs::publishPictures(const sim::Readings& readings, const Stamp& stamp) {
  const sim::CameraModel& camera = parameters_.camera.model;
  if (readings.depth) {
    const auto depth = header(stamp(readings.depth->stamp), camera_frame_);
    depth_info_.publish(toMessage(camera, depth));
    depth_.publish(toMessage(*readings.depth->value, depth));
  }
  if (readings.colour) {
    const auto colour = header(stamp(readings.colour->stamp), camera_frame_);
    colour_info_.publish(toMessage(camera, colour));
    colour_.publish(toMessage(*readings.colour->value, colour));
  }
}

void SimulatorOutputs::publishContacts(const sim::Simulation& simulation,
                                       const sim::Readings& readings, const ros::Time& now) {
  const sim::RobotBase& base = simulation.base();
  const bool changed =
      !readings.contacts.empty() || base.touching() != touching_ || base.dropped() != dropped_;
  if (!changed && readings.time >= contacts_at_ &&
      readings.time - contacts_at_ < kContactPeriod - 1e-6) {
    return;
  }
  touching_ = base.touching();
  dropped_ = base.dropped();
  contacts_at_ = readings.time;
  contacts_.publish(contactsOf(simulation, header(now, kWorld)));
}

}  // namespace pilothouse
