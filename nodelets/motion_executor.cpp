#include <diagnostic_updater/diagnostic_updater.h>
#include <nodelet/nodelet.h>
#include <pilothouse/RouteState.h>
#include <pluginlib/class_list_macros.hpp>

#include "doors/guarded_subscriber.hpp"
#include "doors/motion_views.hpp"
#include "doors/robot_description.hpp"
#include "doors/steady_clock.hpp"
#include "nodelets/base_pose.hpp"
#include "nodelets/executor_holds.hpp"
#include "nodelets/input_health.hpp"
#include "nodelets/wheel_commands.hpp"

namespace pilothouse {

/// Drives routes: route and odom in, cmd_vel/task, route_state and wheel_commands out, 25 times a
/// second on the steady clock.
class MotionExecutorNodelet : public nodelet::Nodelet {
  void onInit() override {
    ros::NodeHandle& handle = getNodeHandle();
    StrictParameters robot_reader(ros::NodeHandle(handle, "robot"));
    const RobotDescription robot = readRobot(robot_reader);
    executor_ = std::make_unique<MotionExecutor>(readParameters(), robot.drive);
    wheels_ = std::make_unique<WheelCommands>(handle, robot.drive, base_frame_);
    command_ = handle.advertise<geometry_msgs::TwistStamped>("cmd_vel/task", 2);
    state_ = handle.advertise<RouteState>("route_state", 10, true);
    diagnostics_ =
        std::make_unique<diagnostic_updater::Updater>(handle, getPrivateNodeHandle(), getName());
    diagnostics_->setHardwareID("none");

    pose_ = std::make_unique<BasePose>(odom_frame_, kOldest);
    subscribe<nav_msgs::Odometry>("odom", odometry_health_,
                                  [this](const auto& odometry) { return pose_->take(odometry); });
    subscribe<nav_msgs::Path>("route", route_health_,
                              [this](const auto& path) { return takeRoute(path); });
    subscribe<SpeedLimit>("speed_limit", limit_health_, [this](const auto& limit) {
      holds_.take(limit, steadyNow());
      return std::string();
    });
    subscribe<StopState>("stop_state", stop_health_, [this](const auto& state) {
      holds_.take(state, steadyNow());
      return std::string();
    });
    diagnostics_timer_ = handle.createWallTimer(
        ros::WallDuration(1.0),
        [this](const ros::WallTimerEvent&) { diagnostics_->force_update(); });
    timer_ = handle.createSteadyTimer(ros::WallDuration(0.04),
                                      [this](const ros::SteadyTimerEvent&) { step(); });
  }

  ExecutorParameters readParameters() {
    ExecutorParameters parameters;
    std::string heading = "free";
    StrictParameters own(getPrivateNodeHandle());
    own.read("base_frame", base_frame_);
    own.read("odom_frame", odom_frame_);
    own.read("heading", heading, {"free", "kept"});
    forEachExecutorParameter(
        parameters, [&own](const char* key, auto& value, const auto& low, const auto& high) {
          own.read(key, value, low, high);
        });
    own.finish();
    parameters.heading = heading == "kept" ? HeadingMode::kKept : HeadingMode::kFree;
    return parameters;
  }

  template <class Message>
  void subscribe(const std::string& topic, InputHealth& health,
                 std::function<std::string(const Message&)> take) {
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

  std::string takeRoute(const nav_msgs::Path& path) {
    const auto wish = openRoute(path);
    std::string fault = wish ? "" : wish.reason();
    std::optional<Pose2> pose;
    if (fault.empty() && !wish->points.empty()) {
      pose = pose_->in(path.header.frame_id, fault);
    }
    unsaid_ = kSaidEvery;  // the next step says what became of it
    refusal_ = fault;
    route_stamp_ = path.header.stamp;
    if (!fault.empty()) {
      // Whoever sent it means the robot to leave the route before, and would not know where it is.
      executor_->cancel();
      points_ = 0;
      return fault;
    }
    frame_ = path.header.frame_id;
    points_ = wish->points.size();
    executor_->drive(wish->points, wish->heading, wish->loop, pose.value_or(Pose2{}));
    return {};
  }

  void step() {
    std::string fault;
    ExecutorInput input;
    input.now = ros::Time::now().toSec();
    ExecutorOutput output;
    if (!executor_->idle()) {
      const auto pose = pose_->in(frame_, fault);
      input.hold = holds_.at(steadyNow(), input.reason);
      input.held_by = holds_.place();
      if (pose) {
        input.pose = *pose;
        output = executor_->step(input);
      } else {
        output.state = ExecutorState::kWaiting;
        output.text = fault;
      }
    }
    const bool busy =
        output.state == ExecutorState::kDriving || output.state == ExecutorState::kWaiting;
    if (busy) busy_until_ = steadyNow() + kLingering;
    // A while of zeros brings the robot to rest; after that there is nothing that a task wants.
    if (steadyNow() <= busy_until_) send(output.wanted);
    const bool changed =
        output.state != last_.state || output.target != last_.target || output.text != last_.text;
    last_ = output;
    if (!changed && ++unsaid_ < kSaidEvery) return;
    unsaid_ = 0;
    say(output);
  }

  void send(const Twist2& wanted) {
    geometry_msgs::TwistStamped command;
    command.header.stamp = ros::Time::now();
    command.header.frame_id = base_frame_;
    command.twist.linear.x = wanted.vx;
    command.twist.linear.y = wanted.vy;
    command.twist.angular.z = wanted.w;
    command_.publish(command);
    wheels_->publish(wanted);
  }

  void say(const ExecutorOutput& output) {
    RouteState message;
    message.header.stamp = ros::Time::now();
    message.header.frame_id = frame_;
    message.route = route_stamp_;
    message.state = static_cast<std::uint8_t>(output.state);
    message.target = static_cast<std::uint32_t>(output.target);
    message.points = static_cast<std::uint32_t>(points_);
    message.distance_left = static_cast<float>(output.distance_left);
    message.text = output.text;
    if (!refusal_.empty()) {
      message.state = RouteState::REFUSED;
      message.text = refusal_;
    }
    state_.publish(message);
  }

  static constexpr BasePose::Limits kOldest{0.3, 0.5};
  static constexpr double kLingering = 2.0;  ///< zeros after the end of a route [s]
  static constexpr int kSaidEvery = 3;       ///< steps between states that say nothing new

  std::string base_frame_ = "base_link", odom_frame_ = "odom", frame_;
  std::unique_ptr<MotionExecutor> executor_;
  std::unique_ptr<WheelCommands> wheels_;
  ExecutorHolds holds_;
  std::unique_ptr<BasePose> pose_;
  ExecutorOutput last_;
  std::size_t points_ = 0;
  double busy_until_ = -1.0;
  int unsaid_ = 0;
  ros::Time route_stamp_;  ///< of the newest, taken or refused
  std::string refusal_;    ///< why the newest route was not taken: said until another comes
  InputHealth odometry_health_{"odom", 1.0}, route_health_{"route", 1e9};
  InputHealth limit_health_{"speed_limit", 1.0}, stop_health_{"stop_state", 1e9};
  ros::Publisher command_, state_;
  std::vector<ros::Subscriber> subscribers_;
  std::unique_ptr<diagnostic_updater::Updater> diagnostics_;
  ros::WallTimer diagnostics_timer_;
  ros::SteadyTimer timer_;
};

}  // namespace pilothouse

PLUGINLIB_EXPORT_CLASS(pilothouse::MotionExecutorNodelet, nodelet::Nodelet)
