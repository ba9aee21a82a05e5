#include <diagnostic_updater/diagnostic_updater.h>
#include <dynamic_reconfigure/server.h>
#include <nodelet/nodelet.h>
#include <pilothouse/StopState.h>
#include <pluginlib/class_list_macros.hpp>

#include "doors/avoidance_settings.hpp"
#include "doors/guarded_subscriber.hpp"
#include "doors/motion_views.hpp"
#include "doors/robot_description.hpp"
#include "nodelets/avoidance_loop.hpp"
#include "nodelets/input_health.hpp"

namespace pilothouse {

/// Keeps a wanted command (cmd_vel/teleop, cmd_vel/task) from touching anything: merges what
/// floor_grid and the rangers see with odom, limits the speed 50 times a second on the steady clock
/// and at once with every new grid.
class Avoidance : public nodelet::Nodelet {
  using Clock = InputHealth::Clock;

  void onInit() override {
    ros::NodeHandle& handle = getNodeHandle();
    StrictParameters robot_reader(ros::NodeHandle(handle, "robot"));
    RobotDescription robot = readRobot(robot_reader);
    AvoidanceLoop::Frames frames;
    StrictParameters own(getPrivateNodeHandle());
    own.read("base_frame", frames.base);
    own.read("odom_frame", frames.odometry);
    readAvoidanceParameters(own, robot.avoidance);
    own.finish();
    loop_ = std::make_unique<AvoidanceLoop>(robot, handle, frames);

    toConfig(robot.avoidance).__toServer__(getPrivateNodeHandle());
    server_ =
        std::make_unique<dynamic_reconfigure::Server<AvoidanceConfig>>(getPrivateNodeHandle());
    server_->setCallback([this](AvoidanceConfig& config, std::uint32_t) { reconfigure(config); });

    diagnostics_ =
        std::make_unique<diagnostic_updater::Updater>(handle, getPrivateNodeHandle(), getName());
    diagnostics_->setHardwareID("none");
    listen(robot);
    diagnostics_timer_ = handle.createWallTimer(
        ros::WallDuration(1.0),
        [this](const ros::WallTimerEvent&) { diagnostics_->force_update(); });
    // Time may be simulated or stand still: the steps do not.
    timer_ = handle.createSteadyTimer(ros::WallDuration(0.02),
                                      [this](const ros::SteadyTimerEvent&) { step(); });
  }

  void listen(const RobotDescription& robot) {
    subscribe<FloorGrid>("floor_grid", [this](const FloorGrid& grid) {
      const std::string fault = loop_->take(grid);
      if (fault.empty()) loop_->step();
      return fault;
    });
    subscribe<nav_msgs::Odometry>(
        "odom", [this](const nav_msgs::Odometry& odometry) { return loop_->take(odometry); });
    for (std::size_t i = 0; i < robot.rangers.size(); ++i) {
      subscribe<sensor_msgs::Range>(
          "range/" + robot.rangers[i].name,
          [this, i](const sensor_msgs::Range& range) { return loop_->take(i, range); });
    }
    subscribe<geometry_msgs::TwistStamped>(
        "cmd_vel/teleop",
        [this](const auto& command) { return loop_->take(CommandChoice::kTeleop, command); },
        false);
    subscribe<geometry_msgs::TwistStamped>(
        "cmd_vel/task",
        [this](const auto& command) { return loop_->take(CommandChoice::kTask, command); }, false);
    subscribe<StopState>(
        "stop_state",
        [this](const StopState& state) {
          loop_->stopped(state.state == StopState::STOPPED);
          return std::string();
        },
        false);
  }

  /// @param take returns why a message was refused; empty: it was not.
  /// @param steady the input's silence is an error.
  template <class Message>
  void subscribe(const std::string& topic, std::function<std::string(const Message&)> take,
                 bool steady = true) {
    healths_.push_back(
        std::make_unique<InputHealth>(getNodeHandle().resolveName(topic), steady ? 1.0 : 1e9));
    InputHealth& health = *healths_.back();
    health.listening(true);
    diagnostics_->add(topic, &health, &InputHealth::report);
    subscribers_.push_back(subscribeGuarded<Message>(
        getNodeHandle(), topic, 8,
        [this, &health, take](const boost::shared_ptr<const Message>& message) {
          const auto begin = Clock::now();
          health.arrived();
          health.stamped(ros::Time::now().toSec() - message->header.stamp.toSec());
          const std::lock_guard<std::mutex> lock(mutex_);
          const std::string fault = take(*message);
          if (fault.empty()) return health.accepted(Clock::now() - begin);
          health.rejected("message", fault);
        },
        [&health](const std::string& reason) { health.rejected("lengths", reason); },
        ros::TransportHints().tcpNoDelay()));
  }

  void reconfigure(AvoidanceConfig& config) {
    const std::lock_guard<std::mutex> lock(mutex_);
    try {
      loop_->setParameters(fromConfig(config));
    } catch (const std::invalid_argument& fault) {
      NODELET_WARN("%s keeps its parameters, refused: %s", getName().c_str(), fault.what());
      config = toConfig(loop_->parameters());
    }
  }

  void step() {
    const std::lock_guard<std::mutex> lock(mutex_);
    loop_->step();
  }

  std::mutex mutex_;  ///< guards the loop: onInit runs in another thread than the callbacks
  std::unique_ptr<AvoidanceLoop> loop_;
  std::vector<std::unique_ptr<InputHealth>> healths_;
  std::vector<ros::Subscriber> subscribers_;
  std::unique_ptr<dynamic_reconfigure::Server<AvoidanceConfig>> server_;
  std::unique_ptr<diagnostic_updater::Updater> diagnostics_;
  ros::WallTimer diagnostics_timer_;
  ros::SteadyTimer timer_;
};

}  // namespace pilothouse

PLUGINLIB_EXPORT_CLASS(pilothouse::Avoidance, nodelet::Nodelet)
