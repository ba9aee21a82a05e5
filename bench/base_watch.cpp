#include "bench/base_watch.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <limits>
#include <stdexcept>
#include <thread>

namespace pilothouse::bench {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
volatile std::sig_atomic_t interrupted = 0;
constexpr double kArm = 0.3;  // turning counts as at this distance [m]

}  // namespace

void pause(double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  throwIfInterrupted();
}

void noticeSignals() {
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, [](int) { interrupted = 1; });
}

void throwIfInterrupted() {
  if (interrupted != 0) throw std::runtime_error("interrupted");
}

BaseWatch::BaseWatch(ros::NodeHandle& handle) {
  const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
  ros::SubscribeOptions commands;
  commands.initByFullCallbackType<const ros::MessageEvent<const geometry_msgs::Twist>&>(
      "cmd_vel", 100,
      [this](const ros::MessageEvent<const geometry_msgs::Twist>& event) { takeCommand(event); });
  commands.transport_hints = hints;
  subscribers_ = {
      handle.subscribe(commands),
      handle.subscribe("ground_truth", 100, &BaseWatch::takeTruth, this, hints),
      handle.subscribe("stop_state", 100, &BaseWatch::takeState, this, hints),
      handle.subscribe("contacts", 100, &BaseWatch::takeContacts, this, hints),
      handle.subscribe("speed_limit", 100, &BaseWatch::takeLimit, this, hints),
      handle.subscribe("camera/depth/camera_info", 100, &BaseWatch::takePicture, this, hints)};
}

void BaseWatch::takeCommand(const ros::MessageEvent<const geometry_msgs::Twist>& event) {
  if (event.getPublisherName() != "/stop_gate") return;  // a fault may be a second publisher
  const geometry_msgs::Twist& twist = *event.getConstMessage();
  const bool zero = twist.linear.x == 0.0 && twist.linear.y == 0.0 && twist.angular.z == 0.0;
  const std::lock_guard<std::mutex> lock(mutex_);
  commands_.push_back({steadyNow(), ros::Time::now().toSec(), zero});
  changed_.notify_all();
}

void BaseWatch::takeTruth(const nav_msgs::Odometry& odometry) {
  const auto& p = odometry.pose.pose;
  const auto& v = odometry.twist.twist;
  Truth truth;
  truth.at = steadyNow();
  truth.pose = {p.position.x, p.position.y, 2.0 * std::atan2(p.orientation.z, p.orientation.w)};
  truth.speed = std::hypot(v.linear.x, v.linear.y) + kArm * std::abs(v.angular.z);
  const std::lock_guard<std::mutex> lock(mutex_);
  truth_ = truth;
  truths_.push_back(truth);
  changed_.notify_all();
}

void BaseWatch::takeState(const StopState& state) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (state.state != StopState::STOPPED)
    stopped_from_ = kNone;
  else if (std::isnan(stopped_from_))
    stopped_from_ = ros::Time::now().toSec();
  state_ = state;
  state_at_ = steadyNow();
  changed_.notify_all();
}

void BaseWatch::takeContacts(const Contacts& contacts) {
  const std::lock_guard<std::mutex> lock(mutex_);
  contacts_ = contacts.count;
}

void BaseWatch::takeLimit(const SpeedLimit& limit) {
  const std::lock_guard<std::mutex> lock(mutex_);
  limit_ = limit;
}

void BaseWatch::takePicture(const sensor_msgs::CameraInfo& info) {
  const std::lock_guard<std::mutex> lock(mutex_);
  pictures_.push_back(info.header.stamp.toSec());
}

void BaseWatch::clear() {
  const std::lock_guard<std::mutex> lock(mutex_);
  commands_.clear();
  truths_.clear();
  pictures_.clear();
}

double BaseWatch::lastingZero() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  double from = kNone;
  for (auto command = commands_.rbegin(); command != commands_.rend() && command->zero; ++command)
    from = command->at;
  return from;
}

int BaseWatch::commandsAfter(double at) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return static_cast<int>(
      std::count_if(commands_.begin(), commands_.end(),
                    [at](const Command& command) { return command.at > at && !command.zero; }));
}

double BaseWatch::slowedAfter(double from) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  double before = 0.0;
  for (const Truth& truth : truths_) {
    if (truth.at <= from + 0.1) before = truth.speed;  // the last command still takes effect
    if (truth.at > from + 0.1 && truth.speed < 0.98 * before) return truth.at;
  }
  return kNone;
}

BaseWatch::Truth BaseWatch::farthestSince(double at) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  Truth farthest;
  const Truth* first = nullptr;
  for (const Truth& truth : truths_) {
    if (truth.at < at) continue;
    if (first == nullptr) first = &truth;
    farthest.at = truth.at;
    farthest.speed = std::max(farthest.speed, truth.speed);
    farthest.pose.x = std::max(farthest.pose.x, std::abs(truth.pose.x - first->pose.x));
    farthest.pose.y = std::max(farthest.pose.y, std::abs(truth.pose.y - first->pose.y));
  }
  return farthest;
}

double BaseWatch::pictureFrom(double stamp) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto found = std::find_if(pictures_.begin(), pictures_.end(),
                                  [stamp](double picture) { return picture >= stamp; });
  return found == pictures_.end() ? kNone : *found;
}

double BaseWatch::zeroFrom(double stamp) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const Command& command : commands_)
    if (command.zero && command.ros >= stamp) return command.ros;
  return kNone;
}

int BaseWatch::commandsFrom(double stamp) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return static_cast<int>(std::count_if(
      commands_.begin(), commands_.end(),
      [stamp](const Command& command) { return command.ros > stamp && !command.zero; }));
}

double BaseWatch::stoppedFrom() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return stopped_from_;
}

std::uint32_t BaseWatch::contacts() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return contacts_;
}

BaseWatch::Truth BaseWatch::truthNow() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return truth_;
}

StopState BaseWatch::stateNow() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return state_;
}

SpeedLimit BaseWatch::limitNow() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return limit_;
}

}  // namespace pilothouse::bench
