#include "bench/stop_rig.hpp"

#include <geometry_msgs/TwistStamped.h>
#include <signal.h>
#include <std_srvs/Trigger.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <stdexcept>

#include "bench/stop_world.hpp"

namespace pilothouse::bench {
namespace {

constexpr double kSpeed = 0.4;           // [m/s]
constexpr double kDriving = 0.3;         // it drives from this speed on [m/s]
constexpr double kUpDeadline = 20.0;     // [s]
constexpr double kDriveDeadline = 60.0;  // with a few stops of a busy computer [s]

/// roslaunch with its words in a file, so that the evaluation's own stay readable.
pid_t startLaunch(const std::string& world, std::uint64_t seed, const std::string& log) {
  return startProcess({"roslaunch", "pilothouse", "stop_trial.launch", "world:=" + world,
                       "seed:=" + std::to_string(seed % 1000000)},
                      log);
}

}  // namespace

StopRig::StopRig(int argc, char** argv, std::uint64_t seed) {
  noticeSignals();
  ros::init(argc, argv, "eval_stop", ros::init_options::NoSigintHandler);
  master_.waitUntilUp();
  const std::string folder = std::getenv("ROS_HOME");
  world_ = folder + "/stop.sdf";
  std::ofstream(world_) << stopWorld();
  handle_ = std::make_unique<ros::NodeHandle>();
  spinner_ = std::make_unique<ros::AsyncSpinner>(2);
  watch_ = std::make_unique<BaseWatch>(*handle_);
  task_ = handle_->advertise<geometry_msgs::TwistStamped>("cmd_vel/task", 2);
  limited_ = handle_->advertise<geometry_msgs::TwistStamped>("cmd_vel/limited", 2);
  spinner_->start();
  driver_ = std::thread([this] { drive(); });
  launch_ = startLaunch(world_, seed, folder + "/launch.log");
}

StopRig::~StopRig() {
  ending_ = true;
  driver_.join();
  endLaunch();
  spinner_->stop();
  ros::shutdown();
}

void StopRig::endLaunch() {
  if (launch_ <= 0) return;
  kill(launch_, SIGINT);
  for (int i = 0; i < 300; ++i) {
    if (waitpid(launch_, nullptr, WNOHANG) != 0) return;
    ros::WallDuration(0.1).sleep();
  }
  kill(launch_, SIGKILL);
  waitpid(launch_, nullptr, 0);
}

void StopRig::drive() {
  while (!ending_) {
    geometry_msgs::TwistStamped wish;
    wish.header.stamp = ros::Time::now();
    wish.twist.linear.x = kSpeed;
    wish.twist.angular.z = kSpeed / kStopWorldCircle;
    if (!silent_) task_.publish(wish);
    ros::WallDuration(0.05).sleep();
  }
}

double StopRig::waitUntilUp() {
  const double from = steadyNow();
  const bool up = watch_->wait(kUpDeadline, [this, from] {
    const bool stopped = watch_->state().state == StopState::STOPPED;
    return watch_->stateFrom() > from && (watch_->state().can_arm || !stopped);
  });
  const StopState state = watch_->stateNow();
  if (!up)
    throw std::runtime_error("the robot does not come up: " + state.obstacle_to_arming + " (" +
                             state.text + "), state " + std::to_string(state.state));
  return steadyNow() - from;
}

void StopRig::armAndDrive() {
  const double deadline = steadyNow() + kDriveDeadline;
  std_srvs::Trigger arm;
  while (steadyNow() < deadline) {
    if (!ros::service::call("stop_gate/arm", arm) || !arm.response.success) {
      pause(0.1);
      continue;
    }
    if (driving(kUpDeadline)) return;
    ++false_stops_;  // nothing was made to fail
  }
  throw std::runtime_error("the robot cannot be armed: " + arm.response.message + " (" +
                           watch_->stateNow().text + ")");
}

bool StopRig::driving(double seconds) {
  const double from = steadyNow();
  bool drives = false;
  watch_->wait(seconds, [&] {
    const bool stopped =
        watch_->stateFrom() > from + 0.1 && watch_->state().state == StopState::STOPPED;
    drives = watch_->truth().at > from && watch_->truth().speed > kDriving && !stopped;
    return drives || stopped;
  });
  return drives;
}

void StopRig::waitUntilDriving() {
  if (driving(kUpDeadline)) return;
  ++false_stops_;
  armAndDrive();
}

}  // namespace pilothouse::bench
