#pragma once

#include <geometry_msgs/TwistStamped.h>
#include <nav_msgs/Odometry.h>
#include <nav_msgs/Path.h>
#include <pilothouse/RouteState.h>
#include <pilothouse/SpeedLimit.h>
#include <pilothouse/StopState.h>
#include <sensor_msgs/Range.h>
#include <tf2_ros/transform_broadcaster.h>

#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "test/floor_harness.hpp"

namespace pilothouse {

/// A robot that stands at (x, 0) and sees an empty floor, in a namespace of its own.
class MotionHarness {
 public:
  MotionHarness() : handle_("/motion" + std::to_string(++count())) {
    XmlRpc::XmlRpcValue robot;
    ros::param::get("/platform/robot", robot);
    handle_.setParam("robot", robot);
    odometry_ = handle_.advertise<nav_msgs::Odometry>("odom", 10);
    grid_ = handle_.advertise<FloorGrid>("floor_grid", 10);
    front_ = handle_.advertise<sensor_msgs::Range>("range/front", 10);
    rear_ = handle_.advertise<sensor_msgs::Range>("range/rear", 10);
    teleop_ = handle_.advertise<geometry_msgs::TwistStamped>("cmd_vel/teleop", 10);
    task_ = handle_.advertise<geometry_msgs::TwistStamped>("cmd_vel/task", 10);
    route_ = handle_.advertise<nav_msgs::Path>("route", 10);
    stop_ = handle_.advertise<StopState>("stop_state", 10);
    take("speed_limit", limit);
    take("cmd_vel/limited", limited);
    take("cmd_vel/task", wanted);
    take("route_state", route_state);
    take("objects/filtered", objects);
    take("objects/front", echoes);
    diagnostics_ = handle_.subscribe<diagnostic_msgs::DiagnosticArray>(
        "/diagnostics", 100, [this](const diagnostic_msgs::DiagnosticArray::ConstPtr& array) {
          for (const auto& status : array->status) {
            for (const auto& value : status.values)
              said_[status.name + "/" + value.key] = value.value;
          }
        });
  }
  ~MotionHarness() { handle_.deleteParam(handle_.getNamespace()); }

  bool load(const std::string& name, const std::string& type) {
    return loader_.load(handle_.getNamespace() + "/" + name, "pilothouse/" + type, ros::M_string(),
                        nodelet::V_string());
  }
  /// Publishes what the sensors see, again and again, until `done`.
  template <class Condition>
  bool runUntil(Condition done, double seconds = 60.0) {
    const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(seconds);
    while (!done() && ros::WallTime::now() < end) {
      sense();
      ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.02));
    }
    return done();
  }
  void sense() {
    const ros::Time now = ros::Time::now();
    nav_msgs::Odometry odometry;
    odometry.header.stamp = now;
    odometry.header.frame_id = odom_frame;
    odometry.child_frame_id = base_frame;
    odometry.pose.pose.position.x = x;
    odometry.pose.pose.orientation.w = 1.0;
    if (wheels) odometry_.publish(odometry);
    if (localised) {
      geometry_msgs::TransformStamped transform;
      transform.header.stamp = now;
      transform.header.frame_id = "hall";
      transform.child_frame_id = "odom";
      transform.transform.rotation.w = 1.0;
      transforms_.sendTransform(transform);
    }
    auto grid = boost::make_shared<FloorGrid>();
    grid->header.stamp = now;
    grid->header.frame_id = "base_link";
    grid->info.resolution = 0.05F;
    grid->info.width = 80;
    grid->info.height = 80;
    grid->info.origin.position.x = 0.2;
    grid->info.origin.position.y = -2.0;
    grid->info.origin.orientation.w = 1.0;
    grid->classes.assign(6400, FloorGrid::FLOOR);
    grid->heights.assign(6400, 0.0F);
    grid->deviations.assign(6400, 0.001F);
    if (camera) grid_.publish(grid);
    for (const auto* publisher : {&front_, &rear_}) {
      sensor_msgs::Range range;
      range.header.stamp = now;
      range.min_range = 0.03F;
      range.max_range = 3.0F;
      range.field_of_view = 0.5F;
      range.range = publisher == &front_ ? front : std::numeric_limits<float>::infinity();
      publisher->publish(range);
    }
    if (teleop != 0.0) command(teleop_, teleop);
    if (task != 0.0) command(task_, task);
  }
  void command(const ros::Publisher& publisher, double speed) {
    geometry_msgs::TwistStamped message;
    message.header.stamp = ros::Time::now();
    message.twist.linear.x = speed;
    publisher.publish(message);
  }
  void drive(const std::vector<std::pair<double, double>>& points, const std::string& frame) {
    nav_msgs::Path path;
    path.header.frame_id = frame;
    path.header.stamp = route_stamp;
    for (const auto& [px, py] : points) {
      path.poses.emplace_back();
      path.poses.back().pose.position.x = px;
      path.poses.back().pose.position.y = py;
    }
    route_.publish(path);
  }
  void gate(std::uint8_t state) {
    StopState message;
    message.state = state;
    message.text = "pressed";
    stop_.publish(message);
  }
  bool gateHeard() const { return stop_.getNumSubscribers() > 0; }
  /// A value of the diagnostics of a nodelet's input.
  std::string said(const std::string& nodelet, const std::string& input, const std::string& key) {
    return said_[handle_.getNamespace().substr(1) + "/" + nodelet + ": " + input + "/" + key];
  }

  double x = 0.0, teleop = 0.0, task = 0.0;
  float front = std::numeric_limits<float>::infinity();
  bool camera = true, wheels = true;
  std::string odom_frame = "odom", base_frame = "base_link";  ///< of the odometry
  bool localised = false;  ///< somebody says where the robot is in the frame hall
  ros::Time route_stamp;   ///< of the routes that are sent
  SpeedLimit limit;
  geometry_msgs::TwistStamped limited, wanted;
  RouteState route_state;
  ObjectList objects, echoes;

 private:
  static int& count() {
    static int made = 0;
    return made;
  }
  template <class M>
  void take(const std::string& topic, M& into) {
    subscribers_.push_back(handle_.subscribe<M>(
        topic, 10, [&into](const boost::shared_ptr<M const>& message) { into = *message; }));
  }
  ros::NodeHandle handle_;
  ros::Publisher odometry_, grid_, front_, rear_, teleop_, task_, route_, stop_;
  tf2_ros::TransformBroadcaster transforms_;
  std::vector<ros::Subscriber> subscribers_;
  ros::Subscriber diagnostics_;
  std::map<std::string, std::string> said_;
  nodelet::Loader loader_{false};
};

}  // namespace pilothouse
