#pragma once

#include <geometry_msgs/TwistStamped.h>
#include <nav_msgs/Odometry.h>
#include <pilothouse/Operator.h>
#include <pilothouse/SpeedLimit.h>
#include <ros/callback_queue.h>
#include <ros/node_handle.h>

#include <array>
#include <atomic>
#include <mutex>
#include <string>
#include <vector>

#include "core/motion/stop_gate.hpp"

namespace pilothouse {

/// A name in memory of fixed size, so that copying it allocates nothing.
using ShortName = std::array<char, 64>;
ShortName shortName(const std::string& name);

/// The newest message of each input of the stop gate, as plain numbers. Its callbacks run on a
/// thread of their own, and hold the lock only while they copy those numbers.
class GateInbox {
 public:
  using Names = std::array<ShortName, kMostConsoles>;

  GateInbox(const GateParameters& parameters, ros::NodeHandle& handle);
  void start() { spinner_.start(); }

  /// Brings `inputs` up to date, all but the time and the other publisher. Never waits: while
  /// another thread writes, they stay as they were and just grow older.
  void read(GateInputs& inputs, Names& names);

  std::uint32_t requestStop() { return ++stop_requests_; }
  std::uint32_t requestArming() { return ++arm_requests_; }
  /// Messages refused by the doors so far, and why the last one was.
  std::pair<std::uint64_t, std::string> refusals();

 private:
  template <class Message>
  void listen(ros::NodeHandle& handle, const std::string& topic,
              void (GateInbox::*take)(const Message&));
  void takeOdometry(const nav_msgs::Odometry& message);
  void takeLimit(const SpeedLimit& message);
  void takeCommand(const geometry_msgs::TwistStamped& message);
  void takeOperator(const Operator& message);
  int slotOf(const ShortName& name, double now) const;
  void refuse(const std::string& reason);

  GateParameters parameters_;
  std::atomic<std::uint32_t> stop_requests_{0}, arm_requests_{0};

  std::mutex mutex_;
  GateInputs newest_;
  Names names_{};
  bool command_read_ = true;

  std::mutex refusals_mutex_;
  std::uint64_t refused_ = 0;
  std::string last_refusal_;

  // Last: the spinner ends before anything that its callbacks use.
  ros::CallbackQueue queue_;
  std::vector<ros::Subscriber> subscribers_;
  ros::AsyncSpinner spinner_{1, &queue_};
};

}  // namespace pilothouse
