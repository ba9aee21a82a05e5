// The whole chain on a simulated platform: simulator, floor, avoidance and executor in this
// process, the real stop gate beside it (drive.test).
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <nav_msgs/Path.h>
#include <pilothouse/Contacts.h>
#include <pilothouse/PlaceModel.h>
#include <pilothouse/RouteState.h>
#include <pilothouse/SpeedLimit.h>
#include <pilothouse/StopState.h>
#include <ros/network.h>
#include <ros/xmlrpc_manager.h>
#include <std_srvs/Trigger.h>
#include <xmlrpcpp/XmlRpcClient.h>

#include "test/box_world.hpp"
#include "test/floor_harness.hpp"

namespace pilothouse {
namespace {

/// A floor, a pillar 12 cm beside the way along x, and a box that stands aside.
std::string worldFile() {
  return writeBoxWorld("drive_test", {{"pillar", 1.8, 0.42, 0.4, 0.0, 0.2, 0.2, 0.8},
                                      {"box", -5.0, 5.0, 0.3, 0.0, 0.4, 0.6, 0.6}});
}

/// Keeps the newest of what the chain says.
class Chain {
 public:
  Chain() {
    handle_.setParam("simulator/world", worldFile());
    handle_.setParam("simulator/camera", "kinect_qvga");
    take("stop_state", gate);
    take("route_state", route_state);
    take("speed_limit", limit);
    take("ground_truth", truth);
    take("contacts", contacts);
  }
  bool load() {
    bool loaded = true;
    for (const char* const type : {"RobotFrames", "DepthFloor", "RangeObjects", "Avoidance",
                                   "MotionExecutor", "Simulator"}) {
      const std::string name =
          type == std::string("Simulator") ? "/simulator" : std::string("/") + type;
      loaded = loaded && loader_.load(name, std::string("pilothouse/") + type, ros::M_string(),
                                      nodelet::V_string());
    }
    return loaded;
  }
  bool arm() {
    return spinUntil([&] {
      std_srvs::Trigger trigger;
      return gate.can_arm && ros::service::call("stop_gate/arm", trigger) &&
             trigger.response.success;
    });
  }
  /// Until `done`; where a busy computer made an input stale, the gate is armed again: how fast
  /// things go is not what is asserted here.
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
  bool place(const std::string& model, double px, double py) {
    PlaceModel place;
    place.request.model = model;
    place.request.pose.x = px;
    place.request.pose.y = py;
    return ros::service::call("simulator/place", place) && place.response.ok;
  }
  void drive(double px, double py) {
    nav_msgs::Path path;
    path.header.frame_id = "world";
    path.poses.resize(1);
    path.poses[0].pose.position.x = px;
    path.poses[0].pose.position.y = py;
    route_.publish(path);
  }
  double x() const { return truth.pose.pose.position.x; }
  double speed() const { return truth.twist.twist.linear.x; }
  /// And not because a busy computer made something stale.
  bool standsBeforeSomething() const {
    return route_state.state == RouteState::WAITING &&
           route_state.text.find("held") != std::string::npos && gate.state != StopState::STOPPED &&
           limit.limit == 0.0F && std::isfinite(limit.distance) && std::abs(speed()) < 1e-3;
  }

  StopState gate;
  RouteState route_state;
  SpeedLimit limit;
  nav_msgs::Odometry truth;
  Contacts contacts;

 private:
  template <class M>
  void take(const std::string& topic, M& into) {
    subscribers_.push_back(handle_.subscribe<M>(
        topic, 10, [&into](const boost::shared_ptr<M const>& message) { into = *message; }));
  }
  ros::NodeHandle handle_;
  ros::Publisher route_ = handle_.advertise<nav_msgs::Path>("route", 1, true);
  std::vector<ros::Subscriber> subscribers_;
  nodelet::Loader loader_{false};
};

/// How this process is joined to the topic: one entry a connection, INTRAPROCESS or TCPROS.
std::vector<std::string> transportsOf(const std::string& topic) {
  std::string host;
  std::uint32_t port = 0;
  ros::network::splitURI(ros::XMLRPCManager::instance()->getServerURI(), host, port);
  XmlRpc::XmlRpcClient self(host.c_str(), static_cast<int>(port), "/");
  XmlRpc::XmlRpcValue request, answer;
  request[0] = ros::this_node::getName();
  EXPECT_TRUE(self.execute("getBusInfo", request, answer));
  std::vector<std::string> transports;
  for (int i = 0; i < answer[2].size(); ++i) {
    if (static_cast<std::string&>(answer[2][i][4]) == topic) {
      transports.push_back(static_cast<std::string&>(answer[2][i][3]));
    }
  }
  return transports;
}

TEST(Drive, SlowsBesideThingsStandsBeforeABoxAndGoesOnWhenItIsGone) {
  Chain chain;
  ASSERT_TRUE(chain.load());
  // A route that comes before the first odometry is refused.
  ASSERT_TRUE(spinUntil([&] { return chain.gate.can_arm; }));
  chain.drive(4.5, 0.0);
  ASSERT_TRUE(spinUntil([&] {
    return chain.route_state.state == RouteState::WAITING &&
           chain.route_state.text.find("stop gate") != std::string::npos;
  }));
  EXPECT_NEAR(chain.x(), 0.0, 0.02) << "nothing moves before it is armed";
  ASSERT_TRUE(chain.arm());
  ASSERT_TRUE(chain.place("box", 3.4, 0.0));

  double beside = 1.0, before = 0.0;
  bool said = false;
  ASSERT_TRUE(chain.driveUntil([&] {
    if (chain.x() < 1.0) before = std::max(before, chain.speed());
    if (chain.x() > 1.5 && chain.x() < 2.0) beside = std::min(beside, chain.speed());
    said = said || (chain.limit.cause == SpeedLimit::POTENTIAL && chain.limit.distance < 0.5F);
    return chain.x() > 2.0 && chain.standsBeforeSomething();
  })) << chain.route_state.text
      << " at " << chain.x();
  EXPECT_GT(before, 0.3);
  EXPECT_LT(beside, 0.2) << "beside the pillar";
  EXPECT_TRUE(said) << "the limit tells of the pillar";
  // The box begins at 3.2, the robot ends 0.25 m before its middle and keeps 0.25 m.
  EXPECT_LE(chain.x(), 3.2 - 0.25 - 0.25 + 0.02);
  EXPECT_GE(chain.x(), 3.2 - 0.25 - 0.25 - 0.2);

  ASSERT_TRUE(chain.place("box", -5.0, 5.0));
  ASSERT_TRUE(chain.driveUntil([&] { return chain.route_state.state == RouteState::REACHED; }))
      << chain.route_state.text << " at " << chain.x();
  EXPECT_NEAR(chain.x(), 4.5, 0.05);
  EXPECT_NEAR(chain.truth.pose.pose.position.y, 0.0, 0.05);
  EXPECT_EQ(chain.contacts.count, 0U);
}

TEST(Drive, EveryDepthPictureIsOneObjectFromTheSimulatorToTheFloor) {
  Chain chain;
  ros::NodeHandle handle;
  Inbox<sensor_msgs::Image> one(handle, "camera/depth/image_rect");
  Inbox<sensor_msgs::Image> other(handle, "camera/depth/image_rect");
  Inbox<FloorGrid> grids(handle, "floor_grid");  // so that the floor listens
  ASSERT_TRUE(chain.load());
  ASSERT_TRUE(grids.waitFor(10));
  ASSERT_TRUE(one.waitFor(10));
  const std::size_t both = std::min(one.all().size(), other.all().size());
  ASSERT_GT(both, 5U);
  for (std::size_t i = 0; i < both; ++i) EXPECT_EQ(one.all()[i].get(), other.all()[i].get());
  const auto transports = transportsOf("/camera/depth/image_rect");
  ASSERT_FALSE(transports.empty());
  for (const auto& transport : transports) EXPECT_EQ(transport, "INTRAPROCESS");
}

}  // namespace
}  // namespace pilothouse

int main(int argc, char** argv) {
  ros::init(argc, argv, "test_drive");
  testing::InitGoogleTest(&argc, argv);
  ros::NodeHandle keeps_ros_alive;
  return RUN_ALL_TESTS();
}
