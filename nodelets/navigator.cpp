#include <diagnostic_updater/diagnostic_updater.h>
#include <nodelet/nodelet.h>
#include <std_srvs/Trigger.h>
#include <pluginlib/class_list_macros.hpp>

#include "doors/guarded_service.hpp"
#include "doors/guarded_subscriber.hpp"
#include "nodelets/input_health.hpp"
#include "nodelets/move_base_server.hpp"
#include "nodelets/route_services.hpp"

namespace pilothouse {

/// Takes goals and routes and drives to them: map_cells, objects/merged, odom and tf in; route for
/// the motion executor, path, navigation_state and task_state out. One thread: its callbacks never
/// run at once.
class Navigator : public nodelet::Nodelet {
  void onInit() override {
    ros::NodeHandle& handle = getNodeHandle();
    StrictParameters robot_reader(ros::NodeHandle(handle, "robot"));
    const RobotDescription robot = readRobot(robot_reader);
    const NavigatorSettings settings = readNavigatorSettings(getPrivateNodeHandle());
    loop_ = std::make_unique<NavigationLoop>(robot, handle, settings);
    diagnostics_ =
        std::make_unique<diagnostic_updater::Updater>(handle, getPrivateNodeHandle(), getName());
    diagnostics_->setHardwareID("none");
    const auto refused = [this](const std::string& reason) {
      NODELET_WARN_STREAM_THROTTLE(1.0, getName() << ": a request was refused: " << reason);
    };
    move_base_ = std::make_unique<MoveBaseServer>(handle, *loop_, refused);
    routes_ = std::make_unique<RouteServices>(handle, *loop_, settings.routes_folder, refused);
    listen();
    serve("task/pause", [this] { return loop_->tasker().pause(); });
    serve("task/resume", [this] { return loop_->tasker().resume(); });
    serve("task/cancel", [this] { return loop_->tasker().cancel(); });
    serve("task/skip", [this] { return loop_->tasker().skip(); });
    diagnostics_timer_ = handle.createWallTimer(
        ros::WallDuration(1.0),
        [this](const ros::WallTimerEvent&) { diagnostics_->force_update(); });
    timer_ = handle.createSteadyTimer(ros::WallDuration(0.1),
                                      [this](const ros::SteadyTimerEvent&) { step(); });
  }

  void listen() {
    subscribe<MapGrid>("map_cells", 1e9, [this](const auto& map) { return loop_->take(map); });
    subscribe<nav_msgs::Odometry>("odom", 1.0,
                                  [this](const auto& odometry) { return loop_->take(odometry); });
    // What blocks the way must not wait for the timer.
    subscribe<ObjectList>("objects/merged", 1.0, [this](const auto& objects) {
      const std::string fault = loop_->take(objects);
      step();
      return fault;
    });
    subscribe<RouteState>("route_state", 1.0,
                          [this](const auto& state) { return loop_->take(state); });
    subscribe<StopState>("stop_state", 1e9,
                         [this](const auto& state) { return loop_->take(state); });
    subscribe<geometry_msgs::TwistStamped>(
        "cmd_vel/teleop", 1e9, [this](const auto& command) { return loop_->take(command); });
    subscribe<geometry_msgs::PoseStamped>("move_base_simple/goal", 1e9, [this](const auto& goal) {
      const auto task = loop_->goTo(goal);
      if (!task) NODELET_WARN_STREAM(getName() << ": " << task.reason());
      return task.reason();
    });
  }

  template <class Message>
  void subscribe(const std::string& topic, double timeout,
                 std::function<std::string(const Message&)> take) {
    healths_.push_back(std::make_unique<InputHealth>(topic, timeout));
    InputHealth& health = *healths_.back();
    health.listening(true);
    diagnostics_->add(topic, &health, &InputHealth::report);
    subscribers_.push_back(subscribeGuarded<Message>(
        getNodeHandle(), topic, 8,
        [&health, take](const boost::shared_ptr<const Message>& message) {
          const auto begin = InputHealth::Clock::now();
          health.arrived();
          const std::string fault = take(*message);
          if (fault.empty()) return health.accepted(InputHealth::Clock::now() - begin);
          health.rejected("message", fault);
        },
        [&health](const std::string& reason) { health.rejected("lengths", reason); },
        ros::TransportHints().tcpNoDelay()));
  }

  /// @param act returns why not; empty: done.
  void serve(const std::string& name, std::function<std::string()> act) {
    using Trigger = std_srvs::Trigger;
    services_.push_back(getNodeHandle().advertiseService<Trigger::Request, Trigger::Response>(
        name, [act](Trigger::Request&, Trigger::Response& response) {
          response.message = act();
          response.success = response.message.empty();
          return true;
        }));
  }

  void step() { move_base_->look(loop_->step()); }

  std::unique_ptr<NavigationLoop> loop_;
  std::unique_ptr<MoveBaseServer> move_base_;
  std::unique_ptr<RouteServices> routes_;
  std::vector<std::unique_ptr<InputHealth>> healths_;
  std::vector<ros::Subscriber> subscribers_;
  std::vector<ros::ServiceServer> services_;
  std::unique_ptr<diagnostic_updater::Updater> diagnostics_;
  ros::WallTimer diagnostics_timer_;
  ros::SteadyTimer timer_;
};

}  // namespace pilothouse

PLUGINLIB_EXPORT_CLASS(pilothouse::Navigator, nodelet::Nodelet)
