#include "gate/gate_inbox.hpp"

#include <algorithm>
#include <cmath>

#include "doors/guarded_subscriber.hpp"
#include "doors/motion_views.hpp"
#include "doors/steady_clock.hpp"

namespace pilothouse {
namespace {

constexpr double kSlotKept = 10.0;  // of a silent console, then another may have it [s]

CommandSource sourceOf(const std::string& name) {
  if (name.empty()) return CommandSource::kNobody;
  if (name == "teleop") return CommandSource::kTeleop;
  return name == "task" ? CommandSource::kTask : CommandSource::kUnknown;
}

/// The largest of what a planar base cannot do; NaN if one of them is.
double offPlane(const geometry_msgs::Twist& twist) {
  double largest = 0.0;
  for (const double x : {twist.linear.z, twist.angular.x, twist.angular.y})
    if (!(std::abs(x) <= largest)) largest = std::abs(x);
  return largest;
}

}  // namespace

ShortName shortName(const std::string& name) {
  ShortName out{};
  std::copy_n(name.begin(), std::min(name.size(), out.size() - 1), out.begin());
  return out;
}

GateInbox::GateInbox(const GateParameters& parameters, ros::NodeHandle& handle)
    : parameters_(parameters) {
  ros::NodeHandle own(handle);
  own.setCallbackQueue(&queue_);
  listen(own, "odom", &GateInbox::takeOdometry);
  listen(own, "speed_limit", &GateInbox::takeLimit);
  listen(own, "cmd_vel/limited", &GateInbox::takeCommand);
  listen(own, "operator", &GateInbox::takeOperator);
}

template <class Message>
void GateInbox::listen(ros::NodeHandle& handle, const std::string& topic,
                       void (GateInbox::*take)(const Message&)) {
  constexpr std::uint32_t kQueue = 20;  // an operator's stop must not be pushed out by what follows
  subscribers_.push_back(subscribeGuarded<Message>(
      handle, topic, kQueue,
      [this, take](const boost::shared_ptr<const Message>& message) { (this->*take)(*message); },
      [this, topic](const std::string& reason) { refuse(topic + ": " + reason); },
      ros::TransportHints().tcpNoDelay()));
}

void GateInbox::takeOdometry(const nav_msgs::Odometry& message) {
  const auto motion = openOdometry(message);
  if (!motion) return refuse("odom: " + motion.reason());
  OdometryMessage odometry;
  odometry.stamp = message.header.stamp.toSec();
  odometry.arrival = steadyNow();
  odometry.pose = motion->pose;
  odometry.twist = motion->twist;
  const std::lock_guard<std::mutex> lock(mutex_);
  newest_.odometry = odometry;
}

void GateInbox::takeLimit(const SpeedLimit& message) {
  LimitMessage limit;
  limit.stamp = message.header.stamp.toSec();
  limit.arrival = steadyNow();
  limit.perception_stamp = message.perception_stamp.toSec();
  limit.command_stamp = message.command_stamp.toSec();
  limit.wanted = static_cast<double>(message.wanted);
  limit.source = sourceOf(message.source);
  const std::lock_guard<std::mutex> lock(mutex_);
  newest_.limit = limit;
}

void GateInbox::takeCommand(const geometry_msgs::TwistStamped& message) {
  CommandMessage command;
  command.stamp = message.header.stamp.toSec();
  command.arrival = steadyNow();
  command.twist = {message.twist.linear.x, message.twist.linear.y, message.twist.angular.z};
  command.off_plane = offPlane(message.twist);
  const std::lock_guard<std::mutex> lock(mutex_);
  // A bad one stays until the gate has seen it, whatever comes after it.
  if (!command_read_ && commandFault(parameters_, newest_.command)) return;
  newest_.command = command;
  command_read_ = false;
}

int GateInbox::slotOf(const ShortName& name, double now) const {
  int free = -1;
  for (int i = 0; i < kMostConsoles; ++i) {
    const auto slot = static_cast<std::size_t>(i);
    const ConsoleMessage& console = newest_.consoles[slot];
    if (console.slot_use != 0 && names_[slot] == name) return i;
    if (console.slot_use == 0 || now - console.arrival > kSlotKept) free = i;
  }
  return free;
}

void GateInbox::takeOperator(const Operator& message) {
  const ShortName name = shortName(message.name);
  const double now = steadyNow();
  const std::lock_guard<std::mutex> lock(mutex_);
  const int found = slotOf(name, now);
  if (found < 0) {  // one console too many may stop, but not drive
    if (message.stop) ++stop_requests_;
    return;
  }
  const auto slot = static_cast<std::size_t>(found);
  ConsoleMessage& console = newest_.consoles[slot];
  if (console.slot_use == 0 || names_[slot] != name) {
    const std::uint32_t use = console.slot_use + 1;
    console = {};
    console.slot_use = use;
    names_[slot] = name;
  }
  ++console.count;
  if (message.stop) ++console.stops;
  console.stamp = message.header.stamp.toSec();
  console.arrival = now;
  console.gate_beat = message.gate_beat;
  console.stop = message.stop;
  console.driving = message.driving;
  console.leaving = message.leaving;
}

void GateInbox::read(GateInputs& inputs, Names& names) {
  const std::unique_lock<std::mutex> lock(mutex_, std::try_to_lock);
  if (lock) {
    inputs.odometry = newest_.odometry;
    inputs.limit = newest_.limit;
    inputs.command = newest_.command;
    inputs.consoles = newest_.consoles;
    names = names_;
    command_read_ = true;
  }
  inputs.stop_requests = stop_requests_;
  inputs.arm_requests = arm_requests_;
}

void GateInbox::refuse(const std::string& reason) {
  const std::lock_guard<std::mutex> lock(refusals_mutex_);
  ++refused_;
  last_refusal_ = reason;
}

std::pair<std::uint64_t, std::string> GateInbox::refusals() {
  const std::lock_guard<std::mutex> lock(refusals_mutex_);
  return {refused_, last_refusal_};
}

}  // namespace pilothouse
