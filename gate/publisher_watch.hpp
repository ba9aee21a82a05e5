#pragma once

#include <geometry_msgs/Twist.h>
#include <ros/callback_queue.h>
#include <ros/node_handle.h>

#include <mutex>
#include <set>
#include <string>

#include "gate/gate_inbox.hpp"

namespace pilothouse {

/// Finds who else publishes on the topic that the stop gate owns: by each message at once, by the
/// connection of a silent one, and by the master's list for a name to tell.
class PublisherWatch {
 public:
  struct Seen {
    bool connected = false;
    double heard = -std::numeric_limits<double>::infinity();  ///< steady [s]
    ShortName name{};
  };

  PublisherWatch(ros::NodeHandle& handle, const std::string& topic);
  void start() { spinner_.start(); }

  /// Never waits: while another thread writes, `seen` stays as it was.
  void read(Seen& seen);
  /// Asks connections and master; slow, so not for the gate's own thread.
  void look();
  /// Names that the master lists besides us; some may be dead.
  std::set<std::string> listed();

 private:
  void hear(const ros::MessageEvent<const geometry_msgs::Twist>& event);
  void askMaster();

  std::string topic_;
  std::mutex mutex_;
  Seen seen_;
  bool own_heard_ = false;  ///< our own publisher is among the connected ones
  std::set<std::string> listed_;

  // Last: the spinner ends before anything that its callback uses.
  ros::CallbackQueue queue_;
  ros::Subscriber subscriber_;
  ros::AsyncSpinner spinner_{1, &queue_};
};

}  // namespace pilothouse
