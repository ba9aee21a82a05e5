#include <nav_msgs/Path.h>
#include <nodelet/nodelet.h>
#include <pilothouse/StopState.h>
#include <std_srvs/Trigger.h>
#include <atomic>
#include <pluginlib/class_list_macros.hpp>
#include <thread>

#include "doors/guarded_subscriber.hpp"
#include "doors/strict_parameters.hpp"

namespace pilothouse {

/// For showing a simulated robot to whoever has none: once the stop gate can be armed, arms it and
/// sends the robot along one of its world's routes (world_routes/NAME). It does so once; after any
/// stop a person arms.
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
    own.finish();
    ros::NodeHandle& handle = getNodeHandle();
    arm_ = handle.serviceClient<std_srvs::Trigger>("stop_gate/arm");
    output_ = handle.advertise<nav_msgs::Path>("route", 1, true);
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
  }

  void start() {
    if (!route_ || !can_arm_ || forbidden_ || arming_.joinable()) return;
    // In a thread of its own: the service's answer may take a while.
    arming_ = std::thread([this, route = route_] { drive(route); });
  }

  void drive(const nav_msgs::Path::ConstPtr& route) {
    for (int tries = 0; tries < kTries && !ending_ && !forbidden_ && ros::ok(); ++tries) {
      std_srvs::Trigger trigger;
      if (arm_.call(trigger) && trigger.response.success) {
        output_.publish(route);
        NODELET_INFO("demonstration: armed once, on its way; after a stop it is yours to arm");
        return;
      }
      NODELET_INFO_STREAM("demonstration: not armed yet: " << trigger.response.message);
      ros::WallDuration(0.5).sleep();
    }
    NODELET_WARN("demonstration: did not get the gate armed; arm it and send a route by hand");
  }

  ros::ServiceClient arm_;
  ros::Publisher output_;
  ros::Subscriber route_input_, state_input_;
  nav_msgs::Path::ConstPtr route_;
  bool can_arm_ = false;
  std::thread arming_;
  static constexpr int kTries = 120;  ///< half a second each
  std::atomic<bool> ending_{false};
  std::atomic<bool> forbidden_{false};  ///< an operator's stop was seen
};

}  // namespace pilothouse

PLUGINLIB_EXPORT_CLASS(pilothouse::Demonstration, nodelet::Nodelet)
