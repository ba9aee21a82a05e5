#include <diagnostic_updater/diagnostic_updater.h>
#include <geometry_msgs/Twist.h>
#include <nodelet/nodelet.h>
#include <pilothouse/PlaceModel.h>
#include <pilothouse/SimulatorFault.h>
#include <ros/wall_timer.h>
#include <std_srvs/Empty.h>
#include <pluginlib/class_list_macros.hpp>

#include "doors/guarded_subscriber.hpp"
#include "nodelets/simulator_thread.hpp"

namespace pilothouse {

/// A robot in a world, in place of a real one: its sensors' topics, its base's cmd_vel. Services
/// ~fault, ~place and ~reset.
class Simulator : public nodelet::Nodelet {
  void onInit() override {
    StrictParameters parameters(getPrivateNodeHandle());
    StrictParameters robot(ros::NodeHandle(getNodeHandle(), "robot"));
    SimulatorSettings settings = readSimulator(parameters, readRobot(robot));
    for (const auto& warning : settings.warnings) NODELET_WARN_STREAM(warning);
    ros::NodeHandle& handle = getMTNodeHandle();
    thread_ = std::make_unique<SimulatorThread>(handle, std::move(settings));
    listen(handle);
    ros::NodeHandle& own = getMTPrivateNodeHandle();
    services_ = {own.advertiseService("fault", &Simulator::onFault, this),
                 own.advertiseService("place", &Simulator::onPlace, this),
                 own.advertiseService("reset", &Simulator::onReset, this)};
    diagnostics_ = std::make_unique<diagnostic_updater::Updater>(handle, own, getName());
    diagnostics_->setHardwareID("simulated");
    diagnostics_->add("simulator", this, &Simulator::report);
    timer_ = handle.createWallTimer(ros::WallDuration(1.0), [this](const ros::WallTimerEvent&) {
      diagnostics_->force_update();
    });
  }

  void listen(ros::NodeHandle& handle) {
    commands_ = subscribeGuarded<geometry_msgs::Twist>(
        handle, "cmd_vel", 1,
        [this](const geometry_msgs::TwistConstPtr& twist) {
          thread_->command({twist->linear.x, twist->linear.y, twist->angular.z});
        },
        [this](const std::string& reason) {
          NODELET_WARN_STREAM_THROTTLE(1.0, "cmd_vel refused: " << reason);
        },
        ros::TransportHints().tcpNoDelay());
  }

  bool onFault(SimulatorFault::Request& request, SimulatorFault::Response& response) {
    const auto kind = sim::faultKind(request.kind);
    if (!kind) {
      response.message =
          "kind is \"" + request.kind + "\", expected freeze, stand, drop, delay, corrupt or none";
      return true;
    }
    const auto reason = thread_->between([&](sim::Simulation& simulation) {
      return simulation.fail(request.sensor, *kind, static_cast<double>(request.amount),
                             static_cast<double>(request.seconds));
    });
    response.ok = !reason;
    response.message = reason.value_or("");
    return true;
  }

  bool onPlace(PlaceModel::Request& request, PlaceModel::Response& response) {
    const auto reason = thread_->between([&](sim::Simulation& simulation) {
      response.stamp = thread_->stampOf(simulation.time());
      return simulation.place(request.model, {request.pose.x, request.pose.y, request.pose.theta});
    });
    response.ok = !reason;
    response.message = reason.value_or("");
    return true;
  }

  bool onReset(std_srvs::Empty::Request&, std_srvs::Empty::Response&) {
    thread_->reset();
    return true;
  }

  void report(diagnostic_updater::DiagnosticStatusWrapper& status) { thread_->report(status); }

  std::unique_ptr<SimulatorThread> thread_;
  ros::Subscriber commands_;
  std::vector<ros::ServiceServer> services_;
  std::unique_ptr<diagnostic_updater::Updater> diagnostics_;
  ros::WallTimer timer_;
};

}  // namespace pilothouse

PLUGINLIB_EXPORT_CLASS(pilothouse::Simulator, nodelet::Nodelet)
