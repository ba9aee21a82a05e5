#include <nav_msgs/Path.h>
#include <nodelet/nodelet.h>
#include <pilothouse/DriveRoute.h>
#include <pilothouse/StopState.h>
#include <pilothouse/TaskState.h>
#include <std_srvs/Trigger.h>
#include <algorithm>
#include <atomic>
#include <limits>
#include <pluginlib/class_list_macros.hpp>
#include <thread>

#include "doors/guarded_subscriber.hpp"
#include "doors/strict_parameters.hpp"

namespace pilothouse {

/// For showing a simulated robot to whoever has none: once the stop gate can be armed, arms it and
/// sends the robot along one of its world's routes (world_routes/NAME). It does so once; after any
/// stop a person arms. The route is a task as anybody's (route/drive), or, where no navigator runs,
/// what the motion executor drives straight away (route).
class Demonstration : public nodelet::Nodelet {
 public:
  ~Demonstration() override {
    ending_ = true;
    if (arming_.joinable()) arming_.join();
  }

 private:
  void onInit() override {
    std::string name = "tour";
    StrictParameters own(getPrivateNodeHandle());
    own.read("route", name);
    own.read("as_task", as_task_);
    own.finish();
    ros::NodeHandle& handle = getNodeHandle();
    arm_ = handle.serviceClient<std_srvs::Trigger>("stop_gate/arm");
    if (as_task_) {
      drive_ = handle.serviceClient<DriveRoute>("route/drive");
    } else {
      output_ = handle.advertise<nav_msgs::Path>("route", 1, true);
    }
    const auto refused = [this](const std::string& reason) {
      NODELET_WARN_STREAM_THROTTLE(1.0, "demonstration: refused: " << reason);
    };
    route_input_ = subscribeGuarded<nav_msgs::Path>(
        handle, "world_routes/" + name, 1,
        [this](const nav_msgs::Path::ConstPtr& route) {
          route_ = route;
          start();
        },
        refused);
    state_input_ = subscribeGuarded<StopState>(
        handle, "stop_state", 1,
        [this](const StopState::ConstPtr& state) {
          can_arm_ = state->can_arm;
          if (state->state == StopState::STOPPED && state->cause == StopState::OPERATOR) {
            forbidden_ = true;  // a person stopped: arming is theirs, also the first time
          }
          if (!can_arm_) {
            NODELET_INFO_STREAM_THROTTLE(5.0,
                                         "demonstration: waits: " << state->obstacle_to_arming);
          }
          start();
        },
        refused);
    if (!as_task_) return;
    task_input_ = subscribeGuarded<TaskState>(
        handle, "task_state", 1,
        [this](const TaskState::ConstPtr& task) { others_ = task->id != 0; }, refused);
  }

  void start() {
    if (!route_ || !can_arm_ || forbidden_ || arming_.joinable()) return;
    // In a thread of its own: the service's answer may take a while.
    arming_ = std::thread([this, route = route_] { drive(route); });
  }

  void drive(const nav_msgs::Path::ConstPtr& route) {
    bool armed = false;
    for (int tries = 0; tries < kTries && !ending_ && !forbidden_ && ros::ok(); ++tries) {
      std::string fault = armed ? "" : arm();
      armed = armed || fault.empty();
      if (armed && others_) {
        NODELET_INFO("demonstration: armed once; somebody else sends the robot already");
        return;
      }
      if (armed) fault = send(*route);
      if (fault.empty()) {
        NODELET_INFO("demonstration: armed once, on its way; after a stop it is yours to arm");
        return;
      }
      NODELET_INFO_STREAM("demonstration: waits: " << fault);
      ros::WallDuration(0.5).sleep();
    }
    NODELET_WARN("demonstration: gave up; arm the gate and send a route by hand");
  }

  // Each returns why not; empty: done.
  std::string arm() {
    std_srvs::Trigger trigger;
    if (arm_.call(trigger) && trigger.response.success) return {};
    return "not armed yet: " + trigger.response.message;
  }
  std::string send(const nav_msgs::Path& route) {
    if (!as_task_) {
      output_.publish(route);
      return {};
    }
    DriveRoute call;
    call.request.route = taskOf(route);
    if (!drive_.call(call)) return "the navigator does not answer";
    return call.response.success ? std::string() : call.response.message;
  }

  /// As the executor has it, a route that ends where it begins goes round and round.
  static GoalRoute taskOf(const nav_msgs::Path& path) {
    GoalRoute route;
    route.header = path.header;
    route.name = "tour";
    for (const auto& pose : path.poses) {
      route.points.emplace_back();
      route.points.back().x = pose.pose.position.x;
      route.points.back().y = pose.pose.position.y;
      route.points.back().heading = std::numeric_limits<double>::quiet_NaN();
    }
    const auto same = [](const RoutePoint& a, const RoutePoint& b) {
      return a.x == b.x && a.y == b.y;
    };
    if (route.points.size() > 2 && same(route.points.front(), route.points.back())) {
      route.points.pop_back();
      // It stands at the first already.
      std::rotate(route.points.begin(), route.points.begin() + 1, route.points.end());
      route.loop = 1;
    }
    return route;
  }

  bool as_task_ = false;
  ros::ServiceClient arm_, drive_;
  ros::Publisher output_;
  ros::Subscriber route_input_, state_input_, task_input_;
  nav_msgs::Path::ConstPtr route_;
  bool can_arm_ = false;
  std::thread arming_;
  static constexpr int kTries = 120;  ///< half a second each
  std::atomic<bool> ending_{false};
  std::atomic<bool> forbidden_{false};  ///< an operator's stop was seen
  std::atomic<bool> others_{false};     ///< somebody gave the robot a task
};

}  // namespace pilothouse

PLUGINLIB_EXPORT_CLASS(pilothouse::Demonstration, nodelet::Nodelet)
