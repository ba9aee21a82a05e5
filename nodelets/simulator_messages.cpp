#include "nodelets/simulator_messages.hpp"

#include <sensor_msgs/distortion_models.h>
#include <sensor_msgs/image_encodings.h>
#include <tf2_eigen/tf2_eigen.h>

#include <boost/make_shared.hpp>
#include <cmath>
#include <cstring>
#include <limits>

namespace pilothouse {
namespace {

template <class Pixel>
sensor_msgs::ImagePtr imageOf(std::uint32_t width, std::uint32_t height, std::size_t channels,
                              const std::vector<Pixel>& pixels, const std::string& encoding,
                              const std_msgs::Header& header) {
  const auto image = boost::make_shared<sensor_msgs::Image>();
  image->header = header;
  image->width = width;
  image->height = height;
  image->encoding = encoding;
  image->step = static_cast<std::uint32_t>(width * channels * sizeof(Pixel));
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(pixels.data());
  image->data.assign(bytes, bytes + pixels.size() * sizeof(Pixel));
  return image;
}

geometry_msgs::Quaternion headingOf(double angle) {
  geometry_msgs::Quaternion rotation;
  rotation.z = std::sin(0.5 * angle);
  rotation.w = std::cos(0.5 * angle);
  return rotation;
}

geometry_msgs::Twist twistOf(const Twist2& twist) {
  geometry_msgs::Twist message;
  message.linear.x = twist.vx;
  message.linear.y = twist.vy;
  message.angular.z = twist.w;
  return message;
}

/// Of (x, y, z, roll, pitch, yaw): what a planar base does not measure is very uncertain.
template <class Covariance>
void setPlanar(Covariance& covariance, double linear, double angular) {
  for (std::size_t i = 0; i < 6; ++i) covariance[7 * i] = 1e6;
  covariance[0] = covariance[7] = linear;
  covariance[35] = angular;
}

}  // namespace

sensor_msgs::ImagePtr toMessage(const sim::DepthImage& image, const std_msgs::Header& header) {
  return imageOf(image.width, image.height, 1, image.millimetres,
                 sensor_msgs::image_encodings::TYPE_16UC1, header);
}

sensor_msgs::ImagePtr toMessage(const sim::ColourImage& image, const std_msgs::Header& header) {
  return imageOf(image.width, image.height, 3, image.rgb, sensor_msgs::image_encodings::RGB8,
                 header);
}

sensor_msgs::CameraInfoPtr toMessage(const sim::CameraModel& camera,
                                     const std_msgs::Header& header) {
  const auto info = boost::make_shared<sensor_msgs::CameraInfo>();
  const Intrinsics& i = camera.intrinsics;
  info->header = header;
  info->width = camera.width;
  info->height = camera.height;
  info->distortion_model = sensor_msgs::distortion_models::PLUMB_BOB;
  info->D.assign(5, 0.0);
  info->K = {i.fx, 0.0, i.cx, 0.0, i.fy, i.cy, 0.0, 0.0, 1.0};
  info->R = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  info->P = {i.fx, 0.0, i.cx, 0.0, 0.0, i.fy, i.cy, 0.0, 0.0, 0.0, 1.0, 0.0};
  return info;
}

nav_msgs::OdometryPtr toMessage(const sim::OdometryReading& reading, const std_msgs::Header& header,
                                const std::string& child) {
  const auto odometry = boost::make_shared<nav_msgs::Odometry>();
  odometry->header = header;
  odometry->child_frame_id = child;
  odometry->pose.pose.position.x = reading.pose.x;
  odometry->pose.pose.position.y = reading.pose.y;
  odometry->pose.pose.orientation = headingOf(reading.pose.heading);
  odometry->twist.twist = twistOf(reading.twist);
  setPlanar(odometry->pose.covariance, 0.01, 0.01);
  setPlanar(odometry->twist.covariance, 1e-4, 1e-4);
  return odometry;
}

nav_msgs::OdometryPtr truthOf(const sim::RobotBase& base, const std_msgs::Header& header,
                              const std::string& child) {
  const auto truth = boost::make_shared<nav_msgs::Odometry>();
  truth->header = header;
  truth->child_frame_id = child;
  truth->pose.pose = tf2::toMsg(base.T_world_base());
  truth->twist.twist = twistOf(base.twist());
  return truth;
}

sensor_msgs::ImuPtr toMessage(const sim::ImuReading& reading, const sim::ImuNoise& noise,
                              const std_msgs::Header& header) {
  const auto imu = boost::make_shared<sensor_msgs::Imu>();
  imu->header = header;
  imu->orientation_covariance[0] = -1.0;  // it does not measure any
  imu->angular_velocity.x = reading.rate.x();
  imu->angular_velocity.y = reading.rate.y();
  imu->angular_velocity.z = reading.rate.z();
  imu->linear_acceleration.x = reading.acceleration.x();
  imu->linear_acceleration.y = reading.acceleration.y();
  imu->linear_acceleration.z = reading.acceleration.z();
  for (std::size_t i = 0; i < 9; i += 4) {
    imu->angular_velocity_covariance[i] = noise.rate * noise.rate;
    imu->linear_acceleration_covariance[i] = noise.acceleration * noise.acceleration;
  }
  return imu;
}

sensor_msgs::JointStatePtr toMessage(const sim::JointReading& reading, const Kinematics& kinematics,
                                     double wheel_radius, const std_msgs::Header& header) {
  const auto joints = boost::make_shared<sensor_msgs::JointState>();
  joints->header = header;
  for (std::size_t i = 0; i < kinematics.wheels().size(); ++i) {
    const std::string& name = kinematics.wheels()[i].name;
    joints->name.push_back(name + "_wheel");
    joints->position.push_back(reading.turned[i]);
    joints->velocity.push_back(reading.wheels[i].speed / wheel_radius);
    if (!kinematics.steered()) continue;
    joints->name.push_back(name + "_steering");
    joints->position.push_back(reading.wheels[i].angle);
    joints->velocity.push_back(std::numeric_limits<double>::quiet_NaN());  // not measured
  }
  return joints;
}

sensor_msgs::RangePtr toMessage(double range, const sim::SimRanger& ranger,
                                const std_msgs::Header& header) {
  const auto message = boost::make_shared<sensor_msgs::Range>();
  message->header = header;
  message->radiation_type = sensor_msgs::Range::ULTRASOUND;
  message->field_of_view = static_cast<float>(ranger.field_of_view);
  message->min_range = static_cast<float>(ranger.min_range);
  message->max_range = static_cast<float>(ranger.max_range);
  message->range = static_cast<float>(range);
  return message;
}

ContactsPtr contactsOf(const sim::Simulation& simulation, const std_msgs::Header& header) {
  const auto contacts = boost::make_shared<Contacts>();
  const sim::RobotBase& base = simulation.base();
  contacts->header = header;
  contacts->count = static_cast<std::uint32_t>(base.contacts().size());
  for (const std::size_t model : base.touching()) {
    contacts->touching.push_back(simulation.nameOf(model));
  }
  if (base.dropped()) contacts->touching.push_back(simulation.nameOf(sim::kNoModel));
  return contacts;
}

geometry_msgs::TransformStamped transformOf(const Pose2& pose, const std_msgs::Header& header,
                                            const std::string& child) {
  geometry_msgs::TransformStamped transform;
  transform.header = header;
  transform.child_frame_id = child;
  transform.transform.translation.x = pose.x;
  transform.transform.translation.y = pose.y;
  transform.transform.rotation = headingOf(pose.heading);
  return transform;
}

}  // namespace pilothouse
