#pragma once

#include <geometry_msgs/Twist.h>
#include <nav_msgs/Odometry.h>
#include <pilothouse/Contacts.h>
#include <pilothouse/SpeedLimit.h>
#include <pilothouse/StopState.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>

#include <condition_variable>
#include <cstdint>
#include <limits>
#include <mutex>
#include <vector>

#include "core/motion/planar.hpp"
#include "doors/steady_clock.hpp"

namespace pilothouse::bench {

/// Waits. @throws std::runtime_error after SIGINT or SIGTERM, so that what was started is ended.
void pause(double seconds);
/// From now on these signals are noticed by throwIfInterrupted().
void noticeSignals();
void throwIfInterrupted();

/// What reaches a base, and what it does, with the instants at which each came.
class BaseWatch {
 public:
  struct Command {
    double at;   ///< steady [s]
    double ros;  ///< [s]
    bool zero;
  };
  struct Truth {
    double at = 0.0;  ///< steady [s]
    Pose2 pose;
    double speed = 0.0;  ///< of the base, turning counted as at 0.3 m [m/s]
  };

  explicit BaseWatch(ros::NodeHandle& handle);

  /// Forgets all that came before now.
  void clear();
  /// Instant of the first zero command of the gate from which on all were zero [s]; NaN: none.
  double lastingZero() const;
  /// Commands of the gate that were not zero after an instant.
  int commandsAfter(double at) const;
  /// Instant at which the base had begun to slow down after `from` [s]; NaN: never.
  double slowedAfter(double from) const;
  /// The farthest way and the highest speed of the base since an instant.
  Truth farthestSince(double at) const;
  /// First stamp of a depth picture that is not before `stamp`, and the first zero command that
  /// came after it; ROS time [s], NaN: none.
  double pictureFrom(double stamp) const;
  double zeroFrom(double stamp) const;
  /// Commands of the gate that were not zero and came after an instant, ROS time [s].
  int commandsFrom(double stamp) const;
  /// Since when the gate says that it is stopped, ROS time [s]; NaN: it does not.
  double stoppedFrom() const;
  /// Contacts of the robot since it was started.
  std::uint32_t contacts() const;

  template <class Condition>
  bool wait(double seconds, Condition holds) {
    const double until = steadyNow() + seconds;
    std::unique_lock<std::mutex> lock(mutex_);
    for (double left = seconds; left > 0.0; left = until - steadyNow()) {
      const std::chrono::duration<double> slice(left < 0.2 ? left : 0.2);
      if (changed_.wait_for(lock, slice, holds)) return true;
      throwIfInterrupted();
    }
    return holds();
  }
  // Only within a condition, or with what stands still.
  const StopState& state() const { return state_; }
  double stateFrom() const { return state_at_; }  ///< when it came, steady [s]
  const Truth& truth() const { return truth_; }

  Truth truthNow() const;
  StopState stateNow() const;
  SpeedLimit limitNow() const;

 private:
  void takeCommand(const ros::MessageEvent<const geometry_msgs::Twist>& event);
  void takeTruth(const nav_msgs::Odometry& odometry);
  void takeState(const StopState& state);
  void takeContacts(const Contacts& contacts);
  void takeLimit(const SpeedLimit& limit);
  void takePicture(const sensor_msgs::CameraInfo& info);

  std::vector<ros::Subscriber> subscribers_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Command> commands_;
  std::vector<Truth> truths_;
  std::vector<double> pictures_;  ///< stamps, ROS time [s]
  StopState state_;
  double state_at_ = 0.0;
  double stopped_from_ = std::numeric_limits<double>::quiet_NaN();  ///< ROS time [s]
  std::uint32_t contacts_ = 0;
  Truth truth_;
  SpeedLimit limit_;
};

}  // namespace pilothouse::bench
