#include "gui/model/ros_link.hpp"

#include <ros/init.h>
#include <ros/master.h>
#include <ros/names.h>

#include <chrono>

#include "gui/model/arming.hpp"
#include "gui/model/clock.hpp"
#include "gui/model/conversions_drive.hpp"
#include "gui/model/floor_wish.hpp"
#include "gui/model/helm_topics.hpp"
#include "gui/model/master.hpp"
#include "gui/model/place_errands.hpp"
#include "gui/model/ros_streams.hpp"

namespace pilothouse::gui {

RosLink::RosLink(std::vector<std::string> arguments, ConsoleState& state, Helm* helm)
    : arguments_(std::move(arguments)),
      state_(state),
      helm_(helm),
      arming_(std::make_unique<ErrandThread>([&state](const std::string& what) {
        if (what.empty()) state.arming.update([](ArmingState& a) { a.asked_at = kUnknown; });
      })),
      floor_(std::make_unique<ErrandThread>([](const std::string&) {})) {}

RosLink::~RosLink() {
  if (thread_.joinable()) thread_.detach();
}

void RosLink::start() {
  thread_ = std::thread([this] {
    run();
    const std::lock_guard<std::mutex> lock(mutex_);
    ended_ = true;
    wake_.notify_all();
  });
}

bool RosLink::stop(double patience) {
  arming_.reset();  // what hangs there goes on without us
  floor_.reset();
  if (!thread_.joinable()) return true;
  {
    std::unique_lock<std::mutex> lock(mutex_);
    stopping_ = true;
    wake_.notify_all();
    const bool ended =
        wake_.wait_for(lock, std::chrono::duration<double>(patience), [&] { return ended_; });
    if (!ended) return false;
  }
  thread_.join();
  return true;
}

void RosLink::askFloor(const std::string& method, bool calibrate) {
  floor_->add("floor", [=, &state = state_] { setFloor(state, method, calibrate); });
}

void RosLink::askArm(StopSerial stops) {
  const ArmWish wish{stops, steadySeconds()};
  const auto refuse = [&state = state_](const std::string& why) {
    if (why.empty()) return;
    state.arming.update([&](ArmingState& arming) {
      arming.refused = {plainText(why), steadySeconds()};
    });
  };
  const bool taken = arming_->add("arm", [refuse, wish, &state = state_, helm = helm_] {
    state.arming.set({wish.at, {}});
    refuse(armTheGate(state, helm, wish));
  });
  if (!taken) refuse("earlier wishes wait still");
}

void RosLink::askPlace(const std::function<void(PlaceAsks&)>& ask) {
  if (const auto errands = errands_.get()) return ask(*errands);
  state_.place.answer.update([](AskAnswer& newest) {
    newest = {newest.serial + 1, false, "no connection to the robot", steadySeconds()};
  });
}

void RosLink::pause(double seconds) {
  std::unique_lock<std::mutex> lock(mutex_);
  wake_.wait_for(lock, std::chrono::duration<double>(seconds), [&] { return stopping_; });
}

void RosLink::setPhase(LinkPhase phase, double round_trip_ms) {
  LinkStatus status = state_.link.get();
  if (status.phase != phase) {
    status.phase = phase;
    status.since = steadySeconds();
  }
  status.master_uri = ros::master::getURI();
  while (!status.master_uri.empty() && status.master_uri.back() == '/')
    status.master_uri.pop_back();
  status.round_trip_ms = round_trip_ms;
  status.looked_at = steadySeconds();
  state_.link.set(status);
}

void RosLink::run() {
  std::vector<char*> argv;
  for (auto& argument : arguments_) argv.push_back(argument.data());
  argv.push_back(nullptr);
  int argc = static_cast<int>(arguments_.size());
  // Two consoles may run side by side, so the name is made unique. Ctrl-C belongs to the window.
  ros::init(argc, argv.data(), "console",
            ros::init_options::AnonymousName | ros::init_options::NoSigintHandler |
                ros::init_options::NoRosout);
  // Without this a call to a master that has just gone would wait for it for ever.
  ros::master::setRetryTimeout(ros::WallDuration(1.0));
  setPhase(LinkPhase::kStarting, 0.0);
  for (;;) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (stopping_) break;
    }
    // Only connected did we start it.
    killed_ = !master_id_.empty() && !ros::ok();
    if (killed_) {
      setPhase(LinkPhase::kLost, 0.0);
      pause(1.0);
      continue;
    }
    pause(connectedStep() ? 0.5 : 1.0);
  }
  endErrands();
  streams_.reset();
  if (helm_) helm_->connect(nullptr);
  if (ros::isStarted()) ros::shutdown();
}

// The GUI thread may hold them still, for an ask that returns at once: their end, which takes long
// and asks the master, is this thread's.
void RosLink::endErrands() {
  const auto errands = errands_.exchange(nullptr);
  while (errands.use_count() > 1) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

bool RosLink::connectedStep() {
  const double before = steadySeconds();
  const std::string id = masterIdentity();
  const double round_trip_ms = (steadySeconds() - before) * 500.0;  // two questions
  if (id.empty()) {
    const LinkPhase phase = state_.link.get().phase;
    const bool was = phase == LinkPhase::kConnected || phase == LinkPhase::kLost;
    setPhase(was ? LinkPhase::kLost : LinkPhase::kNoMaster, 0.0);
    return false;
  }
  if (id != master_id_) {
    // A new master knows nothing of us: end the old subscriptions and make them again.
    endErrands();
    streams_.reset();
    state_.place.forget();  // of the old master's robot
    if (helm_) helm_->connect(nullptr);
    // Started here and not by a first NodeHandle: the last handle to go would shut ROS down.
    if (!ros::isStarted()) ros::start();
    streams_ = std::make_unique<RosStreams>(state_, helm_);
    if (helm_) helm_->connect(std::make_shared<HelmTopics>(state_.clock));
    errands_.set(std::make_shared<PlaceErrands>(state_));
    master_id_ = id;
  }
  setPhase(LinkPhase::kConnected, round_trip_ms);
  LinkStatus status = state_.link.get();
  status.robot = masterText(ros::names::resolve("robot/name"));
  // Asked anew: roscpp read it once, perhaps before the launch file had set it.
  status.simulated_time = masterFlag("/use_sim_time");
  state_.link.set(status);
  streams_->review();
  return true;
}

}  // namespace pilothouse::gui
