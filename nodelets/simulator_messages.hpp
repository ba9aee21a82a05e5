#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/Odometry.h>
#include <pilothouse/Contacts.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/Range.h>

#include "sim/simulation.hpp"

namespace pilothouse {

// What a simulated robot's sensors read, as messages; each in a new shared pointer, with its
// header.

sensor_msgs::ImagePtr toMessage(const sim::DepthImage& image, const std_msgs::Header& header);
sensor_msgs::ImagePtr toMessage(const sim::ColourImage& image, const std_msgs::Header& header);
sensor_msgs::CameraInfoPtr toMessage(const sim::CameraModel& camera,
                                     const std_msgs::Header& header);
nav_msgs::OdometryPtr toMessage(const sim::OdometryReading& reading, const std_msgs::Header& header,
                                const std::string& child);
/// The true pose and velocity.
nav_msgs::OdometryPtr truthOf(const sim::RobotBase& base, const std_msgs::Header& header,
                              const std::string& child);
sensor_msgs::ImuPtr toMessage(const sim::ImuReading& reading, const sim::ImuNoise& noise,
                              const std_msgs::Header& header);
sensor_msgs::JointStatePtr toMessage(const sim::JointReading& reading, const Kinematics& kinematics,
                                     double wheel_radius, const std_msgs::Header& header);
sensor_msgs::RangePtr toMessage(double range, const sim::SimRanger& ranger,
                                const std_msgs::Header& header);
ContactsPtr contactsOf(const sim::Simulation& simulation, const std_msgs::Header& header);

/// header.frame_id -> child.
geometry_msgs::TransformStamped transformOf(const Pose2& pose, const std_msgs::Header& header,
                                            const std::string& child);

}  // namespace pilothouse
