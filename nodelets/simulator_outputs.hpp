#pragma once

#include <ros/node_handle.h>
#include <tf2_ros/transform_broadcaster.h>

#include <functional>
#include <string>
#include <vector>

#include "sim/simulation.hpp"

namespace pilothouse {

/// Publishes what a simulated robot's sensors deliver, and what nobody but a simulator knows: true
/// pose and contacts, the world's routes (world_routes/NAME, latched; one that ends where it begins
/// is a loop). Frames: base_link in odom by odometry; odom in world so that base_link is where it
/// truly is, as a perfect localisation would have it.
class SimulatorOutputs {
 public:
  using Stamp = std::function<ros::Time(double simulated)>;

  /// @param camera_frame optical frame of the pictures.
  SimulatorOutputs(ros::NodeHandle& handle, const sim::SimRobot& robot,
                   const sim::SensorParameters& parameters, std::string camera_frame,
                   const sim::World& world);
  /// @param stamp turns simulated seconds into the time of headers.
  void publish(const sim::Simulation& simulation, const sim::Readings& readings,
               const Stamp& stamp);

 private:
  void publishRoutes(ros::NodeHandle& handle, const sim::World& world);
  void publishOdometry(const sim::Simulation& simulation, const sim::OdometryReading& odometry,
                       const ros::Time& stamp);
  void publishPictures(const sim::Readings& readings, const Stamp& stamp);
  void publishContacts(const sim::Simulation& simulation, const sim::Readings& readings,
                       const ros::Time& now);
  static std_msgs::Header header(const ros::Time& stamp, const std::string& frame);

  sim::SimRobot robot_;
  sim::SensorParameters parameters_;
  Kinematics kinematics_;
  std::string camera_frame_;
  ros::Publisher depth_, depth_info_, colour_, colour_info_, odometry_, imu_, joints_, truth_,
      contacts_;
  std::vector<ros::Publisher> ranges_, routes_;
  tf2_ros::TransformBroadcaster transforms_;
  std::vector<std::size_t> touching_;
  bool dropped_ = false;
  double contacts_at_ = -1.0;  ///< when they were last published [s]
};

}  // namespace pilothouse
