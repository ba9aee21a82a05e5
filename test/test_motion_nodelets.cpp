// The real nodelets avoidance, motion executor and range objects in this process, fed by hand.
#include <geometry_msgs/TwistStamped.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <nav_msgs/Path.h>
#include <pilothouse/RouteState.h>
#include <pilothouse/SpeedLimit.h>
#include <pilothouse/StopState.h>
#include <sensor_msgs/Range.h>
#include <tf2_ros/transform_broadcaster.h>

#include <limits>

#include "test/floor_harness.hpp"

namespace pilothouse {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// A robot that stands at (x, 0) and sees an empty floor, in a namespace of its own.
class MotionHarness {
 public:
  MotionHarness() : handle_("/motion" + std::to_string(++count())) {
    XmlRpc::XmlRpcValue robot;
    ros::param::get("/platform/robot", robot);
    handle_.setParam("robot", robot);
    odometry_ = handle_.advertise<nav_msgs::Odometry>("odom", 10);
    grid_ = handle_.advertise<FloorGrid>("floor_grid", 10);
    front_ = handle_.advertise<sensor_msgs::Range>("range/front", 10);
    rear_ = handle_.advertise<sensor_msgs::Range>("range/rear", 10);
    teleop_ = handle_.advertise<geometry_msgs::TwistStamped>("cmd_vel/teleop", 10);
    task_ = handle_.advertise<geometry_msgs::TwistStamped>("cmd_vel/task", 10);
    route_ = handle_.advertise<nav_msgs::Path>("route", 10);
    stop_ = handle_.advertise<StopState>("stop_state", 10);
    take("speed_limit", limit);
    take("cmd_vel/limited", limited);
    take("cmd_vel/task", wanted);
    take("route_state", route_state);
    take("objects/filtered", objects);
    take("objects/front", echoes);
    diagnostics_ = handle_.subscribe<diagnostic_msgs::DiagnosticArray>(
        "/diagnostics", 100, [this](const diagnostic_msgs::DiagnosticArray::ConstPtr& array) {
          for (const auto& status : array->status) {
            for (const auto& value : status.values)
              said_[status.name + "/" + value.key] = value.value;
          }
        });
  }
  ~MotionHarness() { handle_.deleteParam(handle_.getNamespace()); }

  bool load(const std::string& name, const std::string& type) {
    return loader_.load(handle_.getNamespace() + "/" + name, "pilothouse/" + type, ros::M_string(),
                        nodelet::V_string());
  }
  /// Publishes what the sensors see, again and again, until `done`.
  template <class Condition>
  bool runUntil(Condition done, double seconds = 20.0) {
    const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(seconds);
    while (!done() && ros::WallTime::now() < end) {
      sense();
      ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.02));
    }
    return done();
  }
  void sense() {
    const ros::Time now = ros::Time::now();
    nav_msgs::Odometry odometry;
    odometry.header.stamp = now;
    odometry.header.frame_id = odom_frame;
    odometry.child_frame_id = base_frame;
    odometry.pose.pose.position.x = x;
    odometry.pose.pose.orientation.w = 1.0;
    if (wheels) odometry_.publish(odometry);
    if (localised) {
      geometry_msgs::TransformStamped transform;
      transform.header.stamp = now;
      transform.header.frame_id = "hall";
      transform.child_frame_id = "odom";
      transform.transform.rotation.w = 1.0;
      transforms_.sendTransform(transform);
    }
    auto grid = boost::make_shared<FloorGrid>();
    grid->header.stamp = now;
    grid->header.frame_id = "base_link";
    grid->info.resolution = 0.05F;
    grid->info.width = 80;
    grid->info.height = 80;
    grid->info.origin.position.x = 0.2;
    grid->info.origin.position.y = -2.0;
    grid->info.origin.orientation.w = 1.0;
    grid->classes.assign(6400, FloorGrid::FLOOR);
    grid->heights.assign(6400, 0.0F);
    grid->deviations.assign(6400, 0.001F);
    if (camera) grid_.publish(grid);
    for (const auto* publisher : {&front_, &rear_}) {
      sensor_msgs::Range range;
      range.header.stamp = now;
      range.min_range = 0.03F;
      range.max_range = 3.0F;
      range.field_of_view = 0.5F;
      range.range = publisher == &front_ ? front : std::numeric_limits<float>::infinity();
      publisher->publish(range);
    }
    if (teleop != 0.0) command(teleop_, teleop);
    if (task != 0.0) command(task_, task);
  }
  void command(const ros::Publisher& publisher, double speed) {
    geometry_msgs::TwistStamped message;
    message.header.stamp = ros::Time::now();
    message.twist.linear.x = speed;
    publisher.publish(message);
  }
  void drive(const std::vector<std::pair<double, double>>& points, const std::string& frame) {
    nav_msgs::Path path;
    path.header.frame_id = frame;
    path.header.stamp = route_stamp;
    for (const auto& [px, py] : points) {
      path.poses.emplace_back();
      path.poses.back().pose.position.x = px;
      path.poses.back().pose.position.y = py;
    }
    route_.publish(path);
  }
  void gate(std::uint8_t state) {
    StopState message;
    message.state = state;
    message.text = "pressed";
    stop_.publish(message);
  }
  bool gateHeard() const { return stop_.getNumSubscribers() > 0; }
  /// A value of the diagnostics of a nodelet's input.
  std::string said(const std::string& nodelet, const std::string& input, const std::string& key) {
    return said_[handle_.getNamespace().substr(1) + "/" + nodelet + ": " + input + "/" + key];
  }

  double x = 0.0, teleop = 0.0, task = 0.0;
  float front = std::numeric_limits<float>::infinity();
  bool camera = true, wheels = true;
  std::string odom_frame = "odom", base_frame = "base_link";  ///< of the odometry
  bool localised = false;  ///< somebody says where the robot is in the frame hall
  ros::Time route_stamp;   ///< of the routes that are sent
  SpeedLimit limit;
  geometry_msgs::TwistStamped limited, wanted;
  RouteState route_state;
  ObjectList objects, echoes;

 private:
  static int& count() {
    static int made = 0;
    return made;
  }
  template <class M>
  void take(const std::string& topic, M& into) {
    subscribers_.push_back(handle_.subscribe<M>(
        topic, 10, [&into](const boost::shared_ptr<M const>& message) { into = *message; }));
  }
  ros::NodeHandle handle_;
  ros::Publisher odometry_, grid_, front_, rear_, teleop_, task_, route_, stop_;
  tf2_ros::TransformBroadcaster transforms_;
  std::vector<ros::Subscriber> subscribers_;
  ros::Subscriber diagnostics_;
  std::map<std::string, std::string> said_;
  nodelet::Loader loader_{false};
};

TEST(Avoidance, LetsThroughWhatIsFreeWithTheStampOfTheOriginal) {
  MotionHarness robot;
  ASSERT_TRUE(robot.load("avoidance", "Avoidance"));
  robot.task = 0.3;
  // Both of one step: they come one after the other.
  ASSERT_TRUE(robot.runUntil([&] {
    return robot.limited.twist.linear.x > 0.2 && robot.limit.cause == SpeedLimit::FREE &&
           robot.limited.header.stamp == robot.limit.command_stamp;
  }));
  EXPECT_EQ(robot.limit.source, "task");
  EXPECT_LE((robot.limit.header.stamp - robot.limit.perception_stamp).toSec(), 0.3);
}

TEST(Avoidance, APersonWinsOverATask) {
  MotionHarness robot;
  ASSERT_TRUE(robot.load("avoidance", "Avoidance"));
  robot.task = 0.3;
  robot.teleop = -0.05;
  ASSERT_TRUE(robot.runUntil([&] { return robot.limit.source == "teleop"; }));
  robot.teleop = 0.0;  // the key is let go, its last wish grows old
  EXPECT_TRUE(robot.runUntil([&] { return robot.limit.source == "task"; }));
}

TEST(Avoidance, StandsBeforeAnEchoAndSaysWhichSensorAndHowFar) {
  MotionHarness robot;
  ASSERT_TRUE(robot.load("avoidance", "Avoidance"));
  robot.task = 0.3;
  robot.front = 0.2F;
  // Until its first echo it is "front" that is silent.
  ASSERT_TRUE(robot.runUntil(
      [&] { return robot.limit.sensor == "front" && robot.limit.cause != SpeedLimit::STALE; }));
  EXPECT_TRUE(robot.limit.cause == SpeedLimit::OBSTACLE ||
              robot.limit.cause == SpeedLimit::BRAKING);
  EXPECT_EQ(robot.limit.limit, 0.0F);
  EXPECT_EQ(robot.limited.twist.linear.x, 0.0);
  EXPECT_NEAR(robot.limit.distance, 0.2F, 0.06F);
  ASSERT_TRUE(robot.runUntil([&] { return !robot.objects.objects.empty(); }));
  EXPECT_EQ(robot.objects.sources.size(), 3U);
  robot.front = std::numeric_limits<float>::infinity();
  EXPECT_TRUE(robot.runUntil([&] { return robot.limited.twist.linear.x > 0.1; })) << "goes on";
}

TEST(Avoidance, StandsWhenTheCameraIsSilentAndNamesIt) {
  MotionHarness robot;
  ASSERT_TRUE(robot.load("avoidance", "Avoidance"));
  robot.task = 0.3;
  ASSERT_TRUE(robot.runUntil([&] { return robot.limited.twist.linear.x > 0.1; }));
  robot.camera = false;
  ASSERT_TRUE(robot.runUntil(
      [&] { return robot.limit.cause == SpeedLimit::STALE && robot.limit.sensor == "camera"; }));
  EXPECT_EQ(robot.limited.twist.linear.x, 0.0);
}

TEST(Avoidance, RefusesOdometryOfAnotherFrameOrBodyAndCountsIt) {
  const auto refuses = [](std::string MotionHarness::*frame, const std::string& words) {
    MotionHarness robot;
    ASSERT_TRUE(robot.load("avoidance", "Avoidance"));
    robot.task = 0.3;
    ASSERT_TRUE(robot.runUntil([&] { return robot.limited.twist.linear.x > 0.1; }));
    robot.*frame = "map";
    ASSERT_TRUE(robot.runUntil([&] {
      return robot.limit.cause == SpeedLimit::STALE && robot.limit.sensor == "odometry" &&
             robot.said("avoidance", "odom", "rejected: message") != "";
    })) << words;
    EXPECT_EQ(robot.limited.twist.linear.x, 0.0);
    EXPECT_EQ(robot.said("avoidance", "odom", "last rejection"), words);
  };
  refuses(&MotionHarness::odom_frame,
          "of \"base_link\" in \"map\", expected of \"base_link\" in \"odom\"");
  refuses(&MotionHarness::base_frame,
          "of \"map\" in \"odom\", expected of \"base_link\" in \"odom\"");
}

TEST(Avoidance, StaysAtZeroWhileTheGateIsStopped) {
  MotionHarness robot;
  ASSERT_TRUE(robot.load("avoidance", "Avoidance"));
  ASSERT_TRUE(robot.runUntil([&] {
    robot.gate(StopState::STOPPED);
    return robot.gateHeard();
  }));
  robot.gate(StopState::STOPPED);
  robot.task = 0.4;
  double fastest = 0.0;
  int wanting = 0;  // a second of that would have brought it to 0.4 m/s
  ASSERT_TRUE(robot.runUntil([&] {
    robot.gate(StopState::STOPPED);
    fastest = std::max(fastest, robot.limited.twist.linear.x);
    if (robot.limit.wanted > 0.3F) ++wanting;
    return wanting > 50;
  }));
  EXPECT_LT(fastest, 0.05);
  EXPECT_TRUE(robot.runUntil([&] {
    robot.gate(StopState::IDLE);
    return robot.limited.twist.linear.x > 0.3;
  }));
}

TEST(RangeObjectsNodelet, CountsAReadingThatMeansNothingAndGivesNothingForIt) {
  MotionHarness robot;
  ASSERT_TRUE(robot.load("range_objects", "RangeObjects"));
  robot.front = 1.0F;
  ASSERT_TRUE(robot.runUntil([&] { return !robot.echoes.objects.empty(); }));
  EXPECT_EQ(robot.echoes.source, "front");
  EXPECT_EQ(robot.echoes.header.frame_id, "base_link");
  robot.front = kNan;
  ASSERT_TRUE(robot.runUntil(
      [&] { return robot.said("range_objects", "front", "rejected: message") != ""; }));
  EXPECT_EQ(robot.said("range_objects", "front", "last rejection"),
            "range is nan, expected a number");
}

TEST(ExecutorNodelet, DrivesARouteReachesItAndFallsSilent) {
  MotionHarness robot;
  ASSERT_TRUE(robot.load("executor", "MotionExecutor"));
  ASSERT_TRUE(robot.runUntil([&] { return robot.route_state.state == RouteState::IDLE; }));
  ASSERT_TRUE(robot.runUntil([&] {
    robot.drive({{2.0, 0.0}}, "odom");
    return robot.wanted.twist.linear.x > 0.3 && robot.route_state.state == RouteState::DRIVING;
  }));
  EXPECT_NEAR(robot.route_state.distance_left, 2.0F, 0.05F);
  robot.x = 2.0;
  ASSERT_TRUE(robot.runUntil([&] { return robot.route_state.state == RouteState::REACHED; }));
  EXPECT_EQ(robot.wanted.twist.linear.x, 0.0);
}

TEST(ExecutorNodelet, RefusesWhatIsNoRouteAndSaysWhy) {
  MotionHarness robot;
  ASSERT_TRUE(robot.load("executor", "MotionExecutor"));
  const auto refused = [&](const std::vector<std::pair<double, double>>& points,
                           const std::string& frame, const std::string& reason) {
    robot.route_state = RouteState();
    EXPECT_TRUE(robot.runUntil([&] {
      robot.drive(points, frame);
      return robot.route_state.state == RouteState::REFUSED &&
             robot.route_state.text.find(reason) != std::string::npos;
    })) << robot.route_state.text;
  };
  ASSERT_TRUE(robot.runUntil([&] { return robot.route_state.state == RouteState::IDLE; }));
  refused(std::vector<std::pair<double, double>>(1001, {1.0, 1.0}), "odom", "1001 points");
  refused({{1.0, 0.0}, {std::nan(""), 0.0}}, "odom", "point 1 is nan");
  refused({{1.0, 0.0}}, "moon", "frame \"moon\"");
  refused({{1.0, 0.0}}, "", "frame \"\"");
}

TEST(ExecutorNodelet, StandsWhenItRefusesARouteOnTheWayAndGoesOnSayingSo) {
  MotionHarness robot;
  ASSERT_TRUE(robot.load("executor", "MotionExecutor"));
  ASSERT_TRUE(robot.runUntil([&] { return robot.route_state.state == RouteState::IDLE; }));
  const auto drives = [&] {
    robot.drive({{2.0, 0.0}}, "odom");
    return robot.wanted.twist.linear.x > 0.3 && robot.route_state.state == RouteState::DRIVING;
  };
  ASSERT_TRUE(robot.runUntil(drives));
  ASSERT_TRUE(robot.runUntil([&] {
    robot.drive({{0.0, 2.0}}, "moon");
    return robot.route_state.state == RouteState::REFUSED;
  }));
  // Not sent again: it stays at zero, and what it says is heard whoever comes late.
  EXPECT_TRUE(robot.runUntil([&] { return robot.wanted.twist.linear.x == 0.0; }, 5.0));
  const ros::Time zero = robot.wanted.header.stamp;
  int said = 0;
  ros::Time last = robot.route_state.header.stamp;
  EXPECT_TRUE(robot.runUntil(
      [&] {
        EXPECT_EQ(robot.wanted.twist.linear.x, 0.0);
        EXPECT_EQ(robot.route_state.state, RouteState::REFUSED);
        if (robot.route_state.header.stamp != last) ++said;
        last = robot.route_state.header.stamp;
        return said >= 5 && robot.wanted.header.stamp > zero;
      },
      5.0))
      << said;
  EXPECT_TRUE(robot.runUntil(drives)) << "a good route drives again";
}

TEST(ExecutorNodelet, SaysOfWhichRouteItSpeaks) {
  MotionHarness robot;
  ASSERT_TRUE(robot.load("executor", "MotionExecutor"));
  ASSERT_TRUE(robot.runUntil([&] { return robot.route_state.state == RouteState::IDLE; }));
  EXPECT_TRUE(robot.route_state.route.isZero());
  const auto says = [&](double stamp, std::uint8_t state,
                        const std::vector<std::pair<double, double>>& points,
                        const std::string& frame) {
    robot.route_stamp = ros::Time(stamp);
    return robot.runUntil([&] {
      robot.drive(points, frame);
      return robot.route_state.state == state && robot.route_state.route == ros::Time(stamp);
    });
  };
  EXPECT_TRUE(says(3.5, RouteState::DRIVING, {{2.0, 0.0}}, "odom"));
  EXPECT_TRUE(says(4.5, RouteState::REFUSED, {{2.0, 0.0}}, "moon"));
  EXPECT_TRUE(says(5.5, RouteState::REACHED, {{0.0, 0.0}}, "odom"));
  EXPECT_TRUE(says(6.5, RouteState::IDLE, {}, "odom"));
}

/// A robot that drives in a frame, whose pose then falls silent: it waits, and says why.
void expectWaitsWithout(bool MotionHarness::*input, const std::string& frame,
                        const std::string& reason) {
  MotionHarness robot;
  robot.localised = true;
  ASSERT_TRUE(robot.load("executor", "MotionExecutor"));
  const auto drives = [&] { return robot.wanted.twist.linear.x > 0.05; };
  ASSERT_TRUE(robot.runUntil([&] {
    if (robot.route_state.state == RouteState::IDLE ||
        robot.route_state.state == RouteState::REFUSED)
      robot.drive({{2.0, 0.0}}, frame);
    return drives();
  })) << robot.route_state.text;
  robot.*input = false;
  ASSERT_TRUE(robot.runUntil([&] {
    return robot.route_state.state == RouteState::WAITING &&
           robot.route_state.text.find(reason) != std::string::npos;
  })) << robot.route_state.text;
  ASSERT_TRUE(robot.runUntil([&] { return robot.wanted.twist.linear.x == 0.0; }));
  robot.*input = true;
  EXPECT_TRUE(robot.runUntil(drives)) << "it goes on";
}

TEST(ExecutorNodelet, WaitsWhileOdometryIsSilent) {
  expectWaitsWithout(&MotionHarness::wheels, "odom", "odometry is 0.");
}

TEST(ExecutorNodelet, WaitsWhileItsFrameIsSilent) {
  expectWaitsWithout(&MotionHarness::localised, "hall", "from \"odom\" to \"hall\" is 0.");
}

TEST(ExecutorNodelet, WaitsWhileTheGateIsStoppedAndSaysSo) {
  MotionHarness robot;
  ASSERT_TRUE(robot.load("executor", "MotionExecutor"));
  robot.runUntil([&] { return robot.route_state.state == RouteState::IDLE; });
  EXPECT_TRUE(robot.runUntil([&] {
    if (robot.route_state.state == RouteState::IDLE ||
        robot.route_state.state == RouteState::REFUSED)  // before the first odometry
      robot.drive({{2.0, 0.0}}, "odom");
    robot.gate(StopState::STOPPED);
    return robot.route_state.state == RouteState::WAITING &&
           robot.route_state.text == "stop gate: pressed";
  })) << robot.route_state.text;
}

}  // namespace
}  // namespace pilothouse

int main(int argc, char** argv) {
  ros::init(argc, argv, "test_motion_nodelets");
  testing::InitGoogleTest(&argc, argv);
  ros::NodeHandle keeps_ros_alive;
  return RUN_ALL_TESTS();
}
