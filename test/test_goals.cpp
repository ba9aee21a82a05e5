// Goals through the standard interfaces, on a simulated platform whose map frame is the world: the
// whole chain in this process, the real stop gate beside it (goals.test).
#include <actionlib/client/simple_action_client.h>
#include <gtest/gtest.h>
#include <move_base_msgs/MoveBaseAction.h>
#include <nav_msgs/GetPlan.h>
#include <nav_msgs/Odometry.h>
#include <pilothouse/Contacts.h>
#include <pilothouse/DriveRoute.h>
#include <pilothouse/LoadRoute.h>
#include <pilothouse/MapGrid.h>
#include <pilothouse/NavigationState.h>
#include <pilothouse/PlanPath.h>
#include <pilothouse/SaveRoute.h>
#include <pilothouse/StopState.h>
#include <pilothouse/TaskState.h>
#include <std_srvs/Trigger.h>

#include <cmath>
#include <limits>

#include "test/box_world.hpp"
#include "test/floor_harness.hpp"

namespace pilothouse {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// A hall with a wall across it at x = 2, open from y = -1 to 1; behind that a box that the map
/// does not have.
std::string worldFile() {
  return writeBoxWorld("goals_test", {{"left", 2.0, 2.5, 0.4, 0.0, 0.1, 3.0, 0.8},
                                      {"right", 2.0, -2.5, 0.4, 0.0, 0.1, 3.0, 0.8},
                                      {"box", 3.4, 0.0, 0.3, 0.0, 0.3, 0.3, 0.6}});
}

MapGrid worldMap() {
  MapGrid map;
  map.header.frame_id = "world";
  map.info.resolution = 0.05F;
  map.info.width = 140;   // x from -1 to 6
  map.info.height = 160;  // y from -4 to 4
  map.info.origin.position.x = -1.0;
  map.info.origin.position.y = -4.0;
  map.info.origin.orientation.w = 1.0;
  map.classes.assign(140 * 160, MapGrid::FREE);
  for (std::size_t y = 0; y < 160; ++y) {
    const bool wall = y < 60 || y >= 100;
    for (std::size_t x = 59; x < 61 && wall; ++x) map.classes[y * 140 + x] = MapGrid::OCCUPIED;
    if (y > 150) {
      for (std::size_t x = 80; x < 100; ++x) map.classes[y * 140 + x] = MapGrid::OCCUPIED;
    }
  }
  return map;
}

geometry_msgs::PoseStamped poseAt(double x, double y, double heading,
                                  const std::string& frame = "world") {
  geometry_msgs::PoseStamped pose;
  pose.header.frame_id = frame;
  pose.pose.position.x = x;
  pose.pose.position.y = y;
  pose.pose.orientation.z = std::sin(0.5 * heading);
  pose.pose.orientation.w = std::cos(0.5 * heading);
  return pose;
}

class Goals : public testing::Test {
 protected:
  using Client = actionlib::SimpleActionClient<move_base_msgs::MoveBaseAction>;

  void SetUp() override {
    handle_.setParam("simulator/world", worldFile());
    handle_.setParam("simulator/camera", "kinect_qvga");
    handle_.setParam("Navigator/map_frame", "world");
    handle_.setParam("Navigator/routes_folder", ownFolder() + "/routes");
    take("stop_state", gate);
    take("ground_truth", truth);
    take("contacts", contacts);
    take("navigation_state", navigation);
    take("task_state", task);
    for (const char* const type : {"RobotFrames", "DepthFloor", "RangeObjects", "Avoidance",
                                   "MotionExecutor", "Navigator", "Simulator"}) {
      const std::string name =
          type == std::string("Simulator") ? "/simulator" : std::string("/") + type;
      ASSERT_TRUE(loader_.load(name, std::string("pilothouse/") + type, ros::M_string(),
                               nodelet::V_string()));
    }
    map_.publish(worldMap());
    ASSERT_TRUE(spinUntil([&] { return gate.can_arm && plans(poseAt(1.0, 0.5, 0.0)); }));
  }
  bool plans(const geometry_msgs::PoseStamped& goal) {
    PlanPath path;
    path.request.goal = goal;
    return ros::service::call("plan_path", path) && path.response.found;
  }
  /// Armed whenever it can be: how fast things go is not what is asserted here.
  template <class Condition>
  bool driveUntil(Condition done, double seconds = 240.0) {
    return spinUntil(
        [&] {
          std_srvs::Trigger trigger;
          if (gate.state == StopState::STOPPED && gate.can_arm) {
            ros::service::call("stop_gate/arm", trigger);
          }
          return done();
        },
        seconds);
  }
  double heading() const {
    const auto& q = truth.pose.pose.orientation;
    return 2.0 * std::atan2(q.z, q.w);
  }

  StopState gate;
  nav_msgs::Odometry truth;
  Contacts contacts;
  NavigationState navigation;
  TaskState task;
  ros::NodeHandle handle_;
  ros::Publisher goal_ = handle_.advertise<geometry_msgs::PoseStamped>("move_base_simple/goal", 4);

 private:
  template <class M>
  void take(const std::string& topic, M& into) {
    subscribers_.push_back(handle_.subscribe<M>(
        topic, 10, [&into](const boost::shared_ptr<M const>& message) { into = *message; }));
  }
  ros::Publisher map_ = handle_.advertise<MapGrid>("map_cells", 1, true);
  std::vector<ros::Subscriber> subscribers_;
  nodelet::Loader loader_{false};
};

TEST_F(Goals, AStandardActionClientSendsTheRobotRoundWhatTheMapDoesNotHave) {
  Client client("move_base", false);
  ASSERT_TRUE(spinUntil([&] { return client.isServerConnected(); }));

  // A goal behind the wall's end, with the heading asked for.
  move_base_msgs::MoveBaseGoal goal;
  goal.target_pose = poseAt(4.6, 0.0, 1.57);
  client.sendGoal(goal);
  double aside = 0.0;
  ASSERT_TRUE(driveUntil([&] {
    const auto& place = truth.pose.pose.position;
    if (place.x > 3.2 && place.x < 3.6) aside = std::max(aside, std::abs(place.y));
    return client.getState().isDone();
  })) << navigation.text
      << " at " << truth.pose.pose.position.x;
  EXPECT_EQ(client.getState(), actionlib::SimpleClientGoalState::SUCCEEDED)
      << client.getState().getText();
  EXPECT_LE(std::hypot(truth.pose.pose.position.x - 4.6, truth.pose.pose.position.y), 0.05);
  EXPECT_LE(std::abs(heading() - 1.57), 3.0 * 3.1416 / 180.0);
  EXPECT_GT(aside, 0.3) << "round the box";
  EXPECT_EQ(contacts.count, 0U);
  EXPECT_EQ(task.behaviour, "go_to");
  ASSERT_TRUE(spinUntil([&] { return task.state == TaskState::DONE; }));

  // One within a wall is refused with the reason, and the nearest place that can be reached is
  // told.
  goal.target_pose = poseAt(2.0, 2.0, 0.0);
  client.sendGoal(goal);
  ASSERT_TRUE(driveUntil([&] { return client.getState().isDone(); }));
  EXPECT_EQ(client.getState(), actionlib::SimpleClientGoalState::ABORTED);
  EXPECT_EQ(client.getState().getText(), "something stands at the goal");
  ASSERT_TRUE(spinUntil([&] { return navigation.state == NavigationState::FAILED; }));
  EXPECT_TRUE(navigation.has_nearest);

  // Cancelled by its client.
  goal.target_pose = poseAt(0.5, 0.0, 0.0);
  client.sendGoal(goal);
  ASSERT_TRUE(driveUntil([&] { return navigation.state == NavigationState::DRIVING; }));
  client.cancelGoal();
  ASSERT_TRUE(driveUntil([&] { return client.getState().isDone(); }));
  EXPECT_EQ(client.getState(), actionlib::SimpleClientGoalState::PREEMPTED);
  ASSERT_TRUE(spinUntil([&] { return task.state == TaskState::CANCELLED; }));

  // A bad one that replaces a good one: that has ended for its client, so nothing is driven to.
  client.sendGoal(goal);
  ASSERT_TRUE(spinUntil([&] { return task.state == TaskState::RUNNING; }));
  goal.target_pose = poseAt(kNan, 0.0, 0.0);
  client.sendGoal(goal);
  ASSERT_TRUE(driveUntil([&] { return client.getState().isDone(); }));
  EXPECT_EQ(client.getState(), actionlib::SimpleClientGoalState::ABORTED);
  EXPECT_TRUE(spinUntil([&] { return task.state == TaskState::CANCELLED; }));
}

TEST_F(Goals, BadOnesAreRefusedAndWhatRunsGoesOn) {
  goal_.publish(poseAt(1.0, 0.5, 0.0));
  ASSERT_TRUE(spinUntil([&] {
    goal_.publish(poseAt(1.0, 0.5, 0.0));
    return task.state == TaskState::RUNNING;
  }));
  const auto refused = [&](const geometry_msgs::PoseStamped& bad, const std::string& why) {
    goal_.publish(bad);
    EXPECT_TRUE(spinUntil([&] { return task.refused.find(why) != std::string::npos; }))
        << task.refused << " for " << why;
    EXPECT_EQ(task.state, TaskState::RUNNING);
    EXPECT_NEAR(navigation.goal.x, 1.0, 1e-9);
  };
  refused(poseAt(kNan, 0.0, 0.0), "place is nan");
  refused(poseAt(1e9, 0.0, 0.0), "expected within 10000 m");
  refused(poseAt(0.0, 0.0, 0.0, "nowhere"), "\"nowhere\"");
  auto turned = poseAt(0.0, 0.0, 0.0);
  turned.pose.orientation.w = 7.0;
  refused(turned, "expected a unit quaternion");

  DriveRoute route;
  route.request.route.points.resize(10000);
  ASSERT_TRUE(ros::service::call("route/drive", route));
  EXPECT_FALSE(route.response.success);
  EXPECT_NE(route.response.message.find("10000 points, expected at most 1000"), std::string::npos);
  EXPECT_EQ(task.state, TaskState::RUNNING);
  ASSERT_TRUE(driveUntil([&] { return task.state == TaskState::DONE; })) << navigation.text;
}

TEST_F(Goals, RoutesAreKeptAndDrivenPausedSkippedAndPreviewed) {
  SaveRoute save;
  save.request.file = "round";
  save.request.route.header.frame_id = "world";
  save.request.route.points.resize(2);
  save.request.route.points[0].x = 1.0;
  save.request.route.points[0].y = 0.4;
  save.request.route.points[0].heading = kNan;
  save.request.route.points[0].pause = 100.0F;
  save.request.route.points[1].x = 0.3;
  save.request.route.points[1].y = -0.4;
  save.request.route.points[1].heading = 0.5;
  ASSERT_TRUE(ros::service::call("route/save", save));
  EXPECT_TRUE(save.response.success) << save.response.message;
  save.request.file = "../out";
  ASSERT_TRUE(ros::service::call("route/save", save));
  EXPECT_FALSE(save.response.success);
  LoadRoute load;
  load.request.file = "round";
  ASSERT_TRUE(ros::service::call("route/load", load));
  ASSERT_TRUE(load.response.success) << load.response.message;
  EXPECT_EQ(load.response.files, std::vector<std::string>{"round"});
  ASSERT_EQ(load.response.route.points.size(), 2U);
  EXPECT_EQ(load.response.route.points[1].heading, 0.5);
  EXPECT_TRUE(std::isnan(load.response.route.points[0].heading));

  DriveRoute drive;
  drive.request.route = load.response.route;
  ASSERT_TRUE(ros::service::call("route/drive", drive));
  ASSERT_TRUE(drive.response.success) << drive.response.message;
  ASSERT_TRUE(driveUntil([&] { return navigation.state == NavigationState::PAUSING; }))
      << navigation.text;
  std_srvs::Trigger trigger;
  ASSERT_TRUE(ros::service::call("task/skip", trigger));
  EXPECT_TRUE(trigger.response.success) << trigger.response.message;
  ASSERT_TRUE(driveUntil([&] { return navigation.point == 1; }));
  ASSERT_TRUE(ros::service::call("task/pause", trigger));
  ASSERT_TRUE(driveUntil([&] { return task.state == TaskState::PAUSED; }));
  ASSERT_TRUE(ros::service::call("task/resume", trigger));
  ASSERT_TRUE(driveUntil([&] { return task.state == TaskState::DONE; })) << navigation.text;
  EXPECT_NEAR(truth.pose.pose.position.x, 0.3, 0.05);
  EXPECT_NEAR(heading(), 0.5, 0.053);

  nav_msgs::GetPlan plan;
  plan.request.goal = poseAt(4.6, 0.0, 0.0);
  ASSERT_TRUE(ros::service::call("move_base/make_plan", plan));
  EXPECT_GE(plan.response.plan.poses.size(), 2U);
  PlanPath preview;
  preview.request.goal = poseAt(2.0, 2.0, 0.0);
  ASSERT_TRUE(ros::service::call("plan_path", preview));
  EXPECT_FALSE(preview.response.found);
  EXPECT_EQ(preview.response.message, "something stands at the goal");
  EXPECT_TRUE(preview.response.has_nearest);
  EXPECT_EQ(task.state, TaskState::DONE) << "a preview drives nobody";
}

}  // namespace
}  // namespace pilothouse

int main(int argc, char** argv) {
  ros::init(argc, argv, "test_goals");
  testing::InitGoogleTest(&argc, argv);
  ros::NodeHandle keeps_ros_alive;
  return RUN_ALL_TESTS();
}
