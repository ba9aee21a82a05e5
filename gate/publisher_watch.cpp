#include "gate/publisher_watch.hpp"

#include <ros/master.h>
#include <ros/this_node.h>

#include "doors/guarded_subscriber.hpp"
#include "doors/steady_clock.hpp"

namespace pilothouse {

PublisherWatch::PublisherWatch(ros::NodeHandle& handle, const std::string& topic)
    : topic_(handle.resolveName(topic)) {
  ros::SubscribeOptions options = guardedOptions<geometry_msgs::Twist>(
      topic, 10,
      [this](const ros::MessageEvent<const geometry_msgs::Twist>& event) { hear(event); },
      [this](const std::string&) {
        const std::lock_guard<std::mutex> lock(mutex_);  // we do not send such bytes
        seen_.heard = steadyNow();
      });
  options.callback_queue = &queue_;
  options.transport_hints.tcpNoDelay();
  subscriber_ = handle.subscribe(options);
}

void PublisherWatch::hear(const ros::MessageEvent<const geometry_msgs::Twist>& event) {
  const bool own = event.getPublisherName() == ros::this_node::getName();
  const std::lock_guard<std::mutex> lock(mutex_);
  if (own) {
    own_heard_ = true;
    return;
  }
  seen_.heard = steadyNow();
  seen_.name = shortName(event.getPublisherName());
}

void PublisherWatch::read(Seen& seen) {
  const std::unique_lock<std::mutex> lock(mutex_, std::try_to_lock);
  if (lock) seen = seen_;
}

void PublisherWatch::look() {
  askMaster();
  const std::uint32_t connections = subscriber_.getNumPublishers();
  const std::lock_guard<std::mutex> lock(mutex_);
  seen_.connected = connections > (own_heard_ ? 1U : 0U);
  if (seen_.connected && seen_.name[0] == '\0' && !listed_.empty())
    seen_.name = shortName(*listed_.begin());
}

void PublisherWatch::askMaster() {
  XmlRpc::XmlRpcValue arguments, response, payload;
  arguments[0] = ros::this_node::getName();
  std::set<std::string> others;
  // Without waiting for a master that is gone: the connections still tell.
  if (!ros::master::execute("getSystemState", arguments, response, payload, false)) return;
  if (payload.getType() != XmlRpc::XmlRpcValue::TypeArray || payload.size() < 1) return;
  XmlRpc::XmlRpcValue& publishers = payload[0];
  for (int i = 0; publishers.getType() == XmlRpc::XmlRpcValue::TypeArray && i < publishers.size();
       ++i) {
    if (static_cast<std::string>(publishers[i][0]) != topic_) continue;
    for (int n = 0; n < publishers[i][1].size(); ++n)
      others.insert(static_cast<std::string>(publishers[i][1][n]));
  }
  others.erase(ros::this_node::getName());
  const std::lock_guard<std::mutex> lock(mutex_);
  listed_ = std::move(others);
}

std::set<std::string> PublisherWatch::listed() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return listed_;
}

}  // namespace pilothouse
