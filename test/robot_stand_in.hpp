#pragma once

#include <geometry_msgs/TwistStamped.h>
#include <nav_msgs/Odometry.h>
#include <pilothouse/Operator.h>
#include <pilothouse/SpeedLimit.h>
#include <pilothouse/StopState.h>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>

#include <atomic>
#include <condition_variable>
#include <limits>
#include <mutex>
#include <thread>

namespace pilothouse {

/// Stands for the robot round a real stop gate: publishes what the gate listens to, 50 times a
/// second until told otherwise, and watches what comes of it.
class RobotStandIn {
 public:
  std::atomic<bool> odometry{true}, perception{true}, limiter{true}, command{true};
  std::atomic<bool> console{false}, pressed{false}, driving{false};
  std::atomic<bool> restamped{false};  ///< the last command goes on, unchanged
  std::atomic<bool> turned{false};     ///< odometry tells no orientation that there is
  std::atomic<double> speed{0.2};

  RobotStandIn() {
    odometry_ = handle_.advertise<nav_msgs::Odometry>("odom", 10);
    limit_ = handle_.advertise<SpeedLimit>("speed_limit", 10);
    command_ = handle_.advertise<geometry_msgs::TwistStamped>("cmd_vel/limited", 10);
    operator_ = handle_.advertise<Operator>("operator", 10);
    const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
    state_ = handle_.subscribe("stop_state", 10, &RobotStandIn::takeState, this, hints);
    base_ = handle_.subscribe("cmd_vel", 10, &RobotStandIn::takeCommand, this, hints);
    spinner_.start();
    thread_ = std::thread([this] { publish(); });
  }
  ~RobotStandIn() {
    ending_ = true;
    thread_.join();
    spinner_.stop();
  }

  std_srvs::Trigger::Response call(const std::string& service) {
    std_srvs::Trigger trigger;
    if (!ros::service::waitForService(service, 60000) || !ros::service::call(service, trigger))
      trigger.response.message = "no answer";
    return trigger.response;
  }

  /// Waits until `holds` is true of the newest state and the newest speed on cmd_vel.
  template <class Condition>
  bool wait(Condition holds, double seconds = 60.0) {
    std::unique_lock<std::mutex> lock(mutex_);
    return changed_.wait_for(lock, std::chrono::duration<double>(seconds),
                             [&] { return holds(newest_, base_speed_); });
  }
  StopState state() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return newest_;
  }
  /// Largest speed on cmd_vel since the last call.
  double fastest() {
    const std::lock_guard<std::mutex> lock(mutex_);
    const double fastest = fastest_;
    fastest_ = 0.0;
    return fastest;
  }
  std::uint32_t basePublishers() const { return base_.getNumPublishers(); }

 private:
  void takeState(const StopState& state) {
    const std::lock_guard<std::mutex> lock(mutex_);
    newest_ = state;
    changed_.notify_all();
  }
  void takeCommand(const geometry_msgs::Twist& twist) {
    const std::lock_guard<std::mutex> lock(mutex_);
    base_speed_ = twist.linear.x;
    fastest_ = std::max(fastest_, std::abs(twist.linear.x));
    changed_.notify_all();
  }

  void publish() {
    nav_msgs::Odometry odometry_message;
    odometry_message.pose.pose.orientation.w = 1.0;
    while (!ending_) {
      const ros::Time now = ros::Time::now();
      odometry_message.header.stamp = now;
      odometry_message.pose.pose.position.x += 1e-6;  // moves, however little
      odometry_message.pose.pose.orientation.w = turned ? 2.0 : 1.0;
      if (odometry) odometry_.publish(odometry_message);
      publishOperator(now);
      if (perception) seen_ = now;
      geometry_msgs::TwistStamped twist;
      if (!restamped) made_ = now;
      twist.header.stamp = made_;
      twist.twist.linear.x = speed;
      if (command && limiter) command_.publish(twist);
      SpeedLimit limit;
      limit.header.stamp = now;
      limit.perception_stamp = seen_;
      limit.command_stamp = made_;
      limit.source = driving ? "teleop" : "task";
      limit.wanted = static_cast<float>(speed);
      if (limiter) limit_.publish(limit);
      ros::WallDuration(0.02).sleep();
    }
  }
  void publishOperator(const ros::Time& now) {
    if (!console) return;
    Operator message;
    message.header.stamp = now;
    message.name = "laptop";
    message.stop = pressed;
    message.driving = driving;
    message.gate_beat = state().beat;
    operator_.publish(message);
  }

  ros::NodeHandle handle_;
  ros::AsyncSpinner spinner_{2};
  ros::Publisher odometry_, limit_, command_, operator_;
  ros::Subscriber state_, base_;
  std::atomic<bool> ending_{false};
  ros::Time seen_, made_;
  std::mutex mutex_;
  std::condition_variable changed_;
  StopState newest_;
  double base_speed_ = 0.0, fastest_ = 0.0;
  std::thread thread_;
};

}  // namespace pilothouse
