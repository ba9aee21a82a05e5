#include "nodelets/simulator_outputs.hpp"

#include <nav_msgs/Path.h>

#include <utility>

#include "nodelets/simulator_messages.hpp"

namespace pilothouse {
namespace {

const std::string kWorld = "world", kOdometry = "odom", kBase = "base_link";
constexpr double kContactPeriod = 0.1;  // [s]

}  // namespace

SimulatorOutputs::SimulatorOutputs(ros::NodeHandle& handle, const sim::SimRobot& robot,
                                   const sim::SensorParameters& parameters,
                                   std::string camera_frame, const sim::World& world)
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
  publishRoutes(handle, world);
}

void SimulatorOutputs::publishRoutes(ros::NodeHandle& handle, const sim::World& world) {
  for (const auto& [name, points] : world.routes) {
    nav_msgs::Path path;
    path.header = header(ros::Time::now(), kWorld);
    for (const auto& point : points) {
      path.poses.emplace_back();
      path.poses.back().header = path.header;
      path.poses.back().pose.position.x = point.x();
      path.poses.back().pose.position.y = point.y();
    }
    routes_.push_back(handle.advertise<nav_msgs::Path>("world_routes/" + name, 1, true));
    routes_.back().publish(path);
  }
}

void SimulatorOutputs::publishOdometry(const sim::Simulation& simulation,
                                       const sim::OdometryReading& odometry,
                                       const ros::Time& stamp) {
  odometry_.publish(toMessage(odometry, header(stamp, kOdometry), kBase));
  const Pose2& T_odom_base = odometry.pose;
  const Pose2 T_world_base = simulation.base().pose();
  // The world hangs from odom, not the other way about: odom's parent is the map.
  Pose2 T_odom_world{0.0, 0.0, wrapped(T_odom_base.heading - T_world_base.heading)};
  const Eigen::Vector2d place = T_odom_base.position() - T_odom_world * T_world_base.position();
  T_odom_world.x = place.x();
  T_odom_world.y = place.y();
  transforms_.sendTransform(
      std::vector{transformOf(T_odom_base, header(stamp, kOdometry), kBase),
                  transformOf(T_odom_world, header(stamp, kOdometry), kWorld)});
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
    publishOdometry(simulation, readings.odometry->value, stamp(readings.odometry->stamp));
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
