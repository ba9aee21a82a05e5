#include "bench/stop_trial.hpp"

#include <pilothouse/PlaceModel.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>

#include "bench/node_process.hpp"
#include "bench/stop_world.hpp"

namespace pilothouse::bench {
namespace {

constexpr double kWatched = 1.2;   // so long after a fault it is left as it is [s]
constexpr double kHeld = 0.5;      // and watched when all is well again, before arming [s]
constexpr double kBrakes = 0.7;    // the base needs to stand still [s]
constexpr double kFront = 0.25;    // of the robot's outline before its middle [m]
constexpr double kOneStep = 0.03;  // of a gate that wakes up, with its sending [s]
constexpr double kGap = 0.95;      // within the stop distance, and where the camera can see [m]
constexpr double kResumes = 6.0;   // a robot that stands so long stands for good [s]
constexpr double kDriving = 0.25;  // [m/s]
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

double drawn(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

/// A killed process is back when another one answers in its place.
void waitUntilBack(const std::string& node, pid_t before) {
  const double deadline = steadyNow() + 20.0;
  pid_t now = 0;
  while ((now = processOf(node)) == 0 || now == before) {
    if (steadyNow() > deadline) throw std::runtime_error(node + " does not come back");
    pause(0.02);
  }
}

ros::Time place(double x, double y, double heading) {
  PlaceModel call;
  call.request.model = kStopWorldBox;
  call.request.pose.x = x;
  call.request.pose.y = y;
  call.request.pose.theta = heading;
  if (!ros::service::call("simulator/place", call) || !call.response.ok)
    throw std::runtime_error("the box cannot be placed: " + call.response.message);
  return call.response.stamp;
}

/// Why the robot stands, for a human.
std::string holdOf(const BaseWatch& watch) {
  const SpeedLimit limit = watch.limitNow();
  char place[96];
  std::snprintf(place, sizeof place, " at %.2f m (%.2f, %.2f), limit %.3f m/s",
                static_cast<double>(limit.distance), static_cast<double>(limit.position.x),
                static_cast<double>(limit.position.y), static_cast<double>(limit.limit));
  return watch.stateNow().text + "; limit: cause " + std::to_string(limit.cause) + ", " +
         limit.sensor + place;
}

}  // namespace

StopResult tryFault(StopRig& rig, const StopFault& fault, std::mt19937& random) {
  BaseWatch& watch = rig.watch();
  StopResult result;
  result.fault = fault.name;
  const pid_t before = fault.victim.empty() ? 0 : processOf(fault.victim);
  do {  // a busy computer may have stopped it by itself
    rig.waitUntilDriving();
    pause(drawn(random, 0.1, 0.6));
    watch.clear();
    pause(0.1);
  } while (!std::isnan(watch.lastingZero()));
  const double from = steadyNow();
  fault.inject();
  watch.wait(kWatched, [] { return false; });
  const double healed = steadyNow();
  const double zero = fault.base_halts ? watch.slowedAfter(from) : watch.lastingZero();
  result.to_zero = zero - from;
  if (fault.heal) fault.heal();
  const double begun = fault.heal ? healed : from;
  if (!fault.victim.empty()) waitUntilBack(fault.victim, before);
  rig.waitUntilUp();
  result.up_again = steadyNow() - begun;
  result.cause = watch.stateNow().text;
  pause(kHeld);
  result.commands_after =
      watch.commandsAfter(std::isnan(zero) ? healed : zero + (fault.base_halts ? 0.1 : 0.0));
  if (fault.base_halts && fault.heal) {
    const int late = result.commands_after - watch.commandsAfter(healed + kOneStep);
    result.in_flight = std::clamp(late, 0, 1);
    result.commands_after -= result.in_flight;
  }
  if (!fault.restarts_robot) {
    const auto farthest = watch.farthestSince(from + std::min(result.to_zero, 0.5) + kBrakes);
    result.moved = std::hypot(farthest.pose.x, farthest.pose.y);
  }
  rig.armAndDrive();
  return result;
}

AppearanceResult tryAppearance(StopRig& rig, std::mt19937& random) {
  BaseWatch& watch = rig.watch();
  AppearanceResult result;
  BaseWatch::Truth truth;
  do {  // until it drives at the very moment
    rig.waitUntilDriving();
    pause(drawn(random, 0.3, 1.0));
    watch.clear();
    truth = watch.truthNow();
  } while (!(truth.speed > kDriving));
  result.speed = truth.speed;
  const std::uint32_t contacts = watch.contacts();
  const double ahead = kFront + kGap + 0.5 * kStopWorldBoxEdge;
  const Eigen::Vector2d spot =
      advanced(truth.pose, {ahead, 0.0, ahead / kStopWorldCircle}, 1.0).position();
  const double placed = place(spot.x(), spot.y(), truth.pose.heading).toSec();
  watch.wait(1.5, [] { return false; });
  const double picture = watch.pictureFrom(placed);
  const double zero = watch.zeroFrom(placed);
  result.to_zero = zero - picture;
  result.from_place = zero - placed;
  result.commands_after = watch.commandsFrom(zero);
  result.beforehand = watch.stoppedFrom() < picture;
  watch.clear();
  const double away = steadyNow();
  place(kStopWorldBoxAway, kStopWorldBoxAway, 0.0);
  bool resumed = false;
  watch.wait(kResumes, [&] {
    result.stopped = watch.state().state == StopState::STOPPED;
    resumed = !result.stopped && watch.truth().at > away && watch.truth().speed > 0.02;
    return resumed || result.stopped;
  });
  result.resumed = resumed ? steadyNow() - away : kNone;
  if (!resumed) result.held_by = holdOf(watch);
  if (result.stopped) result.cause = watch.stateNow().text;
  result.contacts = watch.contacts() - contacts;
  return result;
}

}  // namespace pilothouse::bench
