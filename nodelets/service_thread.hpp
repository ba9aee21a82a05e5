#pragma once

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>

#include <utility>
#include <vector>

namespace pilothouse {

/// Answers services that may take their time (a disk is waited for) in a thread of its own, so that
/// no message waits behind them. Not a nodelet's multi-threaded queue: a nodelet that is unloaded
/// while a message is taken is destroyed after that queue, which roscpp's services do not survive.
class ServiceThread {
 public:
  /// @param beside names are resolved as by this handle.
  explicit ServiceThread(const ros::NodeHandle& beside) : handle_(beside) {
    handle_.setCallbackQueue(&queue_);
    spinner_.start();
  }
  ServiceThread(const ServiceThread&) = delete;
  ServiceThread& operator=(const ServiceThread&) = delete;

  /// To offer services by.
  ros::NodeHandle& handle() { return handle_; }
  /// Offered until this is destroyed, which waits for one that is being answered.
  void keep(ros::ServiceServer service) { services_.push_back(std::move(service)); }

 private:
  ros::CallbackQueue queue_;
  ros::NodeHandle handle_;
  ros::AsyncSpinner spinner_{1, &queue_};
  std::vector<ros::ServiceServer> services_;  ///< the first to go
};

}  // namespace pilothouse
