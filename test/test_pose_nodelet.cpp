// The real PoseTracker on a simulated platform whose odometry slips: simulator, floor and tracker
// in this process.
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/Twist.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <pilothouse/MapGrid.h>
#include <tf2_msgs/TFMessage.h>

#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "core/pose/pose_algebra.hpp"
#include "doors/motion_views.hpp"
#include "test/box_world.hpp"
#include "test/floor_harness.hpp"

namespace pilothouse {
namespace {

/// A room with things in it.
const std::vector<WorldBox> kRoom = {
    {"north", 0.0, 2.5, 0.5, 0.0, 6.0, 0.1, 1.0},   {"south", 0.0, -2.5, 0.5, 0.0, 6.0, 0.1, 1.0},
    {"west", -3.0, 0.0, 0.5, 0.0, 0.1, 5.0, 1.0},   {"east", 3.0, 0.0, 0.5, 0.0, 0.1, 5.0, 1.0},
    {"shelf", 1.7, 2.1, 0.5, 0.0, 0.8, 0.6, 1.0},   {"chest", 2.5, -1.4, 0.3, 0.0, 0.7, 0.9, 0.6},
    {"crate", -2.4, -1.8, 0.3, 0.5, 0.6, 0.5, 0.6}, {"desk", -2.2, 1.9, 0.4, 0.0, 1.0, 0.6, 0.8}};

std::string worldFile() {
  return writeBoxWorld("pose_test", kRoom);
}

/// The room as a map, with a threshold across its middle that no scanner sees.
MapGrid mapOfTheRoom() {
  MapGrid map;
  map.header.frame_id = "map";
  map.info.resolution = 0.05F;
  map.info.width = map.info.height = 160;
  map.info.origin.position.x = map.info.origin.position.y = -4.0;
  map.info.origin.orientation.w = 1.0;
  for (int row = 0; row < 160; ++row) {
    for (int column = 0; column < 160; ++column) {
      const Eigen::Vector2d place(-4.0 + 0.05 * (column + 0.5), -4.0 + 0.05 * (row + 0.5));
      auto kind = std::abs(place.x() - 0.8) < 0.1 ? MapGrid::THRESHOLD : MapGrid::FREE;
      for (const WorldBox& box : kRoom) {
        const Eigen::Vector2d inside = Pose2{box.x, box.y, box.turn}.toBase(place);
        if (std::abs(inside.x()) <= 0.5 * box.length && std::abs(inside.y()) <= 0.5 * box.width) {
          kind = MapGrid::OCCUPIED;
        }
      }
      map.classes.push_back(kind);
    }
  }
  return map;
}

Pose2 poseOf(const nav_msgs::Odometry& odometry) {
  const auto motion = openOdometry(odometry);
  return motion ? motion->pose : Pose2{};
}

/// Simulator, floor and tracker; between odometry and tracker the test makes the wheels slip.
class PoseNodelet : public testing::Test {
 protected:
  void SetUp() override {
    handle_.setParam("simulator/world", worldFile());
    handle_.setParam("simulator/camera", "kinect_qvga");
    ros::M_string remapped{{handle_.resolveName("odom"), handle_.resolveName("slipped/odom")},
                           {handle_.resolveName("imu/data"), handle_.resolveName("no_imu")}};
    const auto load = [this](const char* name, const char* type, const ros::M_string& names) {
      return loader_.load(handle_.resolveName(name), std::string("pilothouse/") + type, names,
                          nodelet::V_string());
    };
    ASSERT_TRUE(load("robot_frames", "RobotFrames", {}) && load("floor", "DepthFloor", {}) &&
                load("pose_tracker", "PoseTracker", remapped) &&
                load("simulator", "Simulator", {}));
    ASSERT_TRUE(spinUntil([this] {
      return !pose_.all().empty() && !corrections_.empty() && command_.getNumSubscribers() > 0;
    }));
  }
  void TearDown() override {
    for (const char* name : {"simulator", "pose_tracker", "floor", "robot_frames"}) {
      loader_.unload(handle_.resolveName(name));
    }
  }

  /// The base counts 10 % too much of its way and 20 % too much of its turns.
  void slip(const nav_msgs::Odometry& odometry) {
    const Pose2 pose = poseOf(odometry);
    if (begun_) {
      const Pose2 step = relative(counted_, pose);
      slipped_ = composed(slipped_, {1.1 * step.x, 1.1 * step.y, 1.2 * step.heading});
      way_ += step.position().norm();
      turn_ += std::abs(step.heading);
    }
    begun_ = true;
    counted_ = pose;
    command_.publish(twist_);  // no faster than the simulator goes
    publishSlipped(odometry.header.stamp);
  }
  void publishSlipped(const ros::Time& stamp) {
    nav_msgs::Odometry message;
    message.header.stamp = stamp;
    message.header.frame_id = "odom";
    message.child_frame_id = "base_link";
    message.pose.pose.position.x = slipped_.x;
    message.pose.pose.position.y = slipped_.y;
    message.pose.pose.orientation.z = std::sin(0.5 * slipped_.heading);
    message.pose.pose.orientation.w = std::cos(0.5 * slipped_.heading);
    counted_at_[stamp] = slipped_;
    odometry_.publish(message);
  }
  /// Drives as far as these speeds lead in so many seconds, however slow the machine is: what the
  /// wheels count ends it, before they slip. Then it stands.
  void drive(double vx, double w, double seconds) {
    const double way = way_ + std::abs(vx) * seconds, turn = turn_ + std::abs(w) * seconds;
    command(vx, w);
    EXPECT_TRUE(spinUntil([&] { return way_ >= way && turn_ >= turn; }, 60.0));
    command(0.0, 0.0);
  }
  void command(double vx, double w) {
    twist_.linear.x = vx;
    twist_.angular.z = w;
    command_.publish(twist_);
  }
  void setPose(double x, double y, double heading, double variance, const std::string& frame) {
    geometry_msgs::PoseWithCovarianceStamped pose;
    pose.header.stamp = ros::Time::now();
    pose.header.frame_id = frame;
    pose.pose.pose.position.x = x;
    pose.pose.pose.position.y = y;
    pose.pose.pose.orientation.z = std::sin(0.5 * heading);
    pose.pose.pose.orientation.w = std::cos(0.5 * heading);
    for (const std::size_t place : {0U, 7U, 35U}) pose.pose.covariance[place] = variance;
    initial_.publish(pose);
  }
  /// Where the tracker has the robot, newest.
  Pose2 tracked() const {
    const auto& pose = pose_.all().back()->pose.pose;
    return {pose.position.x, pose.position.y,
            2.0 * std::atan2(pose.orientation.z, pose.orientation.w)};
  }
  void takeTransforms(const tf2_msgs::TFMessage& message) {
    for (const auto& transform : message.transforms) {
      if (transform.child_frame_id != "odom") continue;
      EXPECT_EQ(transform.header.frame_id, "map");
      const auto& t = transform.transform;
      corrections_[transform.header.stamp] = {t.translation.x, t.translation.y,
                                              2.0 * std::atan2(t.rotation.z, t.rotation.w)};
    }
  }
  void takeDiagnostics(const diagnostic_msgs::DiagnosticArray& message) {
    for (const auto& status : message.status) {
      for (const auto& value : status.values) diagnostics_[status.name][value.key] = value.value;
    }
  }
  std::string diagnostic(const std::string& task, const std::string& key) {
    return diagnostics_[taskOf(task)][key];
  }
  std::string taskOf(const std::string& task) const {
    return handle_.resolveName("pose_tracker").substr(1) + ": " + task;
  }

  ros::NodeHandle handle_;
  Pose2 counted_, slipped_;
  bool begun_ = false;
  double way_ = 0.0, turn_ = 0.0;                        ///< counted, before the slip [m, rad]
  geometry_msgs::Twist twist_;                           ///< wanted
  std::map<ros::Time, Pose2> counted_at_, corrections_;  ///< T_odom_base, T_map_odom
  std::map<std::string, std::map<std::string, std::string>> diagnostics_;
  ros::Publisher odometry_ = handle_.advertise<nav_msgs::Odometry>("slipped/odom", 10);
  ros::Publisher command_ = handle_.advertise<geometry_msgs::Twist>("cmd_vel", 1);
  ros::Publisher initial_ =
      handle_.advertise<geometry_msgs::PoseWithCovarianceStamped>("initialpose", 1);
  Inbox<nav_msgs::Odometry> truth_{handle_, "ground_truth"};
  Inbox<geometry_msgs::PoseWithCovarianceStamped> pose_{handle_, "pose"};
  ros::Subscriber wheels_ = handle_.subscribe<nav_msgs::Odometry>(
      "odom", 100, [this](const nav_msgs::Odometry::ConstPtr& m) { slip(*m); });
  ros::Subscriber transforms_ = handle_.subscribe<tf2_msgs::TFMessage>(
      "/tf", 100, [this](const tf2_msgs::TFMessage::ConstPtr& m) { takeTransforms(*m); });
  ros::Subscriber diagnosed_ = handle_.subscribe<diagnostic_msgs::DiagnosticArray>(
      "/diagnostics", 100,
      [this](const diagnostic_msgs::DiagnosticArray::ConstPtr& m) { takeDiagnostics(*m); });
  nodelet::Loader loader_{false};
};

TEST_F(PoseNodelet, StaysNearerToTheTruthThanSlippingOdometry) {
  // The first scan is the map: only what moves after it can be corrected.
  ASSERT_TRUE(spinUntil([this] { return diagnostic("matches", "matches: accepted") >= "1"; }));
  for (int round = 0; round < 2; ++round) {
    drive(0.25, 0.0, 3.0);
    drive(0.15, 0.5, 4.0);
    drive(0.0, -0.6, 5.0);
    drive(-0.2, 0.0, 2.0);
    drive(0.2, 0.4, 4.0);
    if (round == 0) drive(0.0, 0.6, 4.2);  // back to the middle of the room
  }
  std::optional<Pose2> start_truth, start_raw, start_corrected;
  double raw = 0.0, corrected = 0.0;
  int compared = 0;
  for (const auto& message : truth_.all()) {
    const auto odometry = counted_at_.find(message->header.stamp);
    const auto correction = corrections_.find(message->header.stamp);
    // The transform has odometry's own stamp: whoever looks at the newest odometry finds it.
    if (odometry == counted_at_.end() || correction == corrections_.end()) continue;
    const Pose2 truth = poseOf(*message), counted = odometry->second;
    const Pose2 in_map = composed(correction->second, counted);
    if (!start_truth) start_truth = truth, start_raw = counted, start_corrected = in_map;
    const Pose2 way = relative(*start_truth, truth);
    raw += (relative(*start_raw, counted).position() - way.position()).squaredNorm();
    corrected += (relative(*start_corrected, in_map).position() - way.position()).squaredNorm();
    ++compared;
  }
  ASSERT_GT(compared, 500);
  raw = std::sqrt(raw / compared);
  corrected = std::sqrt(corrected / compared);
  RecordProperty("raw_rms_mm", static_cast<int>(1e3 * raw));
  RecordProperty("corrected_rms_mm", static_cast<int>(1e3 * corrected));
  EXPECT_GT(raw, 0.1) << "it hardly slipped";
  std::string matches;
  for (const auto& [key, value] : diagnostics_[taskOf("matches")])
    matches += key + " " + value + "\n";
  EXPECT_LT(corrected, 0.5 * raw) << matches;
}

TEST_F(PoseNodelet, GoesWhereItIsSetAndRefusesWhatCannotBe) {
  ASSERT_TRUE(spinUntil([this] { return initial_.getNumSubscribers() > 0; }));
  setPose(10.0, 5.0, 1.5, 0.01, "map");
  ASSERT_TRUE(spinUntil([this] { return std::abs(tracked().x - 10.0) < 0.1; }));
  EXPECT_NEAR(tracked().y, 5.0, 0.1);
  EXPECT_NEAR(tracked().heading, 1.5, 0.1);
  EXPECT_GT(pose_.all().back()->pose.covariance[0], 0.0);

  setPose(std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0, 0.01, "map");
  setPose(0.0, 0.0, 0.0, 0.01, "odom");
  setPose(0.0, 0.0, 0.0, -0.01, "map");
  ASSERT_TRUE(spinUntil([this] { return diagnostic("initialpose", "rejected") == "3"; }));
  EXPECT_NE(diagnostic("initialpose", "last rejection").find("positive semidefinite"),
            std::string::npos);
  EXPECT_EQ(diagnostic("initialpose", "accepted"), "1");
  const std::size_t before = pose_.all().size();
  ASSERT_TRUE(pose_.waitFor(before + 20));
  EXPECT_NEAR(tracked().x, 10.0, 0.1);
  EXPECT_NEAR(tracked().y, 5.0, 0.1);
}

/// The same robot in a map that it is given.
class PoseInMap : public PoseNodelet {
 protected:
  void SetUp() override {
    handle_.setParam("pose_tracker/match", "map");
    PoseNodelet::SetUp();
  }
  void TearDown() override {
    PoseNodelet::TearDown();
    handle_.deleteParam("pose_tracker/match");
  }
  /// Where the robot is by the newest truth that the tracker has spoken of, seen from there.
  std::optional<Pose2> error() const {
    for (auto truth = truth_.all().rbegin(); truth != truth_.all().rend(); ++truth) {
      const ros::Time stamp = (*truth)->header.stamp;
      const auto odometry = counted_at_.find(stamp);
      const auto correction = corrections_.find(stamp);
      if (odometry == counted_at_.end() || correction == corrections_.end()) continue;
      return relative(poseOf(**truth), composed(correction->second, odometry->second));
    }
    return std::nullopt;
  }
  bool isRight() const {
    const auto off = error();
    return off && off->position().norm() < 0.08 && std::abs(off->heading) < 0.05;
  }

  ros::Publisher map_ = handle_.advertise<MapGrid>("map_cells", 1, true);
};

TEST_F(PoseInMap, FindsBackFromAPoseSetBadly) {
  map_.publish(mapOfTheRoom());
  ASSERT_TRUE(spinUntil([this] {
    return diagnostic("map_cells", "accepted") == "1" && error() && initial_.getNumSubscribers();
  }));
  const Pose2 truth = poseOf(*truth_.all().back());
  const Pose2 wrong = composed(truth, {0.25, -0.16, 0.175});
  setPose(wrong.x, wrong.y, wrong.heading, 0.1, "map");
  ASSERT_TRUE(spinUntil([this] { return diagnostic("initialpose", "accepted") == "1"; }));
  for (int round = 0; round < 6 && !isRight(); ++round) drive(0.0, 0.5, 2.0);
  EXPECT_TRUE(isRight()) << error()->position().norm() << " m, " << error()->heading << " rad off";
  // And stays there while the wheels slip.
  for (int round = 0; round < 2; ++round) {
    drive(0.2, 0.4, 4.0);
    drive(-0.2, -0.3, 3.0);
  }
  EXPECT_TRUE(isRight()) << error()->position().norm() << " m, " << error()->heading << " rad off";
  EXPECT_EQ(diagnostic("map_cells", "rejected"), "0");
  MapGrid broken = mapOfTheRoom();
  broken.classes.pop_back();
  map_.publish(broken);
  EXPECT_TRUE(spinUntil([this] { return diagnostic("map_cells", "rejected") == "1"; }));
}

TEST_F(PoseNodelet, GoesOnWhenTimeRunsBack) {
  ASSERT_TRUE(spinUntil([this] { return pose_.all().size() > 20; }));
  wheels_.shutdown();
  const ros::Time back = ros::Time::now() - ros::Duration(100.0);
  publishSlipped(back);
  publishSlipped(back + ros::Duration(0.02));
  ASSERT_TRUE(spinUntil([&] { return corrections_.count(back + ros::Duration(0.02)) > 0; }));
  EXPECT_TRUE(spinUntil([this] { return diagnostic("odom", "time jumps") == "1"; }));
}

TEST(PoseParameters, RefusesToStartOnWhatIsWrong) {
  ros::NodeHandle handle("/wrong");
  nodelet::Loader loader(false);
  for (const char* key : {"gate", "scans", "match", "no_such_key"}) {
    handle.deleteParam("pose_tracker");
    handle.setParam(std::string("pose_tracker/") + key, "");
    EXPECT_FALSE(loader.load("/wrong/pose_tracker", "pilothouse/PoseTracker", ros::M_string(),
                             nodelet::V_string()))
        << key;
  }
}

}  // namespace
}  // namespace pilothouse

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "test_pose_nodelet");
  ros::NodeHandle keep;
  return RUN_ALL_TESTS();
}
