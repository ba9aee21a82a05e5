// The real Simulator nodelet: topics, commands, faults, placing, refusals.
#include <geometry_msgs/Twist.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <pilothouse/Contacts.h>
#include <pilothouse/PlaceModel.h>
#include <pilothouse/SimulatorFault.h>
#include <rosgraph_msgs/Log.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/Range.h>
#include <std_srvs/Empty.h>
#include <tf2_ros/transform_listener.h>

#include <cmath>
#include <fstream>

#include "test/box_world.hpp"
#include "test/floor_harness.hpp"

namespace pilothouse {
namespace {

/// A world of the test's own, in a file: floor, and a box 2 m ahead.
std::string worldFile() {
  return writeBoxWorld("simulator_test", {{"box", 2.0, 0.0, 0.2, 0.0, 0.4, 0.4, 0.4}});
}

/// A simulator in a namespace of its own, whose robot the launch file put there.
class SimulatorTest : public testing::Test {
 protected:
  SimulatorTest() : handle_("/" + std::string("platform")), name_("/platform/simulator") {
    handle_.setParam("simulator/world", worldFile());
    handle_.setParam("simulator/camera", "tof");
  }
  ~SimulatorTest() override {
    loader_.unload(name_);
    handle_.deleteParam("simulator");
  }
  bool load() {
    return loader_.load(name_, "pilothouse/Simulator", ros::M_string(), nodelet::V_string());
  }
  /// Commands 20 times a second while `going` says so.
  template <class Going>
  bool driveWhile(double vx, Going going, double seconds = 60.0) {
    geometry_msgs::Twist twist;
    twist.linear.x = vx;
    ros::WallTime next;
    return spinUntil(
        [&] {
          if (ros::WallTime::now() >= next) {
            commands_.publish(twist);
            next = ros::WallTime::now() + ros::WallDuration(0.05);
          }
          return !going();
        },
        seconds);
  }
  bool waitForBase() {
    return spinUntil([this] { return commands_.getNumSubscribers() > 0; });
  }

  ros::NodeHandle handle_;
  std::string name_;
  ros::Publisher commands_ = handle_.advertise<geometry_msgs::Twist>("cmd_vel", 1);
  nodelet::Loader loader_{false};
};

TEST_F(SimulatorTest, PublishesItsSensorsInTheirFrames) {
  Inbox<sensor_msgs::Image> depth(handle_, "camera/depth/image_rect");
  Inbox<sensor_msgs::CameraInfo> info(handle_, "camera/depth/camera_info");
  Inbox<sensor_msgs::Image> colour(handle_, "camera/rgb/image_rect_color");
  Inbox<nav_msgs::Odometry> odometry(handle_, "odom"), truth(handle_, "ground_truth");
  Inbox<sensor_msgs::Imu> imu(handle_, "imu/data");
  Inbox<sensor_msgs::JointState> joints(handle_, "joint_states");
  Inbox<sensor_msgs::Range> front(handle_, "range/front"), rear(handle_, "range/rear");
  Inbox<Contacts> contacts(handle_, "contacts");
  const ros::Time before = ros::Time::now();
  ASSERT_TRUE(load());
  ASSERT_TRUE(depth.waitFor(2) && info.waitFor(2) && colour.waitFor(2) && odometry.waitFor(2));
  ASSERT_TRUE(imu.waitFor(2) && joints.waitFor(2) && front.waitFor(2) && rear.waitFor(2));
  ASSERT_TRUE(contacts.waitFor(2) && truth.waitFor(2));
  EXPECT_EQ(depth.all()[0]->encoding, "16UC1");
  EXPECT_EQ(depth.all()[0]->width, 160U);
  EXPECT_EQ(depth.all()[0]->header.frame_id, "camera_depth_optical_frame");
  EXPECT_EQ(depth.all()[0]->header.stamp, info.all()[0]->header.stamp);
  EXPECT_GE(depth.all()[0]->header.stamp, before);
  EXPECT_LE(depth.all()[0]->header.stamp, ros::Time::now());
  EXPECT_EQ(colour.all()[0]->encoding, "rgb8");
  EXPECT_EQ(odometry.all()[0]->header.frame_id, "odom");
  EXPECT_EQ(odometry.all()[0]->child_frame_id, "base_link");
  EXPECT_EQ(truth.all()[0]->header.frame_id, "world");
  EXPECT_EQ(joints.all()[0]->name.size(), 8U);
  EXPECT_EQ(joints.all()[0]->name[0], "front_left_wheel");
  EXPECT_EQ(joints.all()[0]->name[1], "front_left_steering");
  EXPECT_EQ(front.all()[0]->header.frame_id, "range_front");
  EXPECT_NEAR(front.all()[1]->range, 1.8 - 0.25, 0.05);
  EXPECT_TRUE(std::isinf(rear.all()[1]->range)) << "nothing behind";
  EXPECT_EQ(contacts.all()[0]->count, 0U);
  EXPECT_NEAR(imu.all()[0]->linear_acceleration.z, 9.81, 0.3);
}

TEST_F(SimulatorTest, GoesByCommandsAndHaltsInSilence) {
  Inbox<nav_msgs::Odometry> odometry(handle_, "odom");
  ASSERT_TRUE(load());
  ASSERT_TRUE(waitForBase() && odometry.waitFor(1));
  const auto speed = [&] { return odometry.all().back()->twist.twist.linear.x; };
  ASSERT_TRUE(driveWhile(0.2, [&] { return speed() < 0.15; })) << "never got going";
  EXPECT_TRUE(spinUntil([&] { return speed() == 0.0; })) << "still at " << speed();
  EXPECT_GT(odometry.all().back()->pose.pose.position.x, 0.02);
}

TEST_F(SimulatorTest, CountsContactsAndTakesTheRobotElsewhere) {
  Inbox<Contacts> contacts(handle_, "contacts");
  Inbox<nav_msgs::Odometry> truth(handle_, "ground_truth");
  ASSERT_TRUE(load());
  ASSERT_TRUE(waitForBase() && contacts.waitFor(1));
  PlaceModel place;
  place.request.model = "box";
  place.request.pose.x = 0.6;
  ASSERT_TRUE(ros::service::call(name_ + "/place", place));
  EXPECT_TRUE(place.response.ok) << place.response.message;
  EXPECT_LE(place.response.stamp, ros::Time::now());
  ASSERT_TRUE(driveWhile(0.3, [&] { return contacts.all().back()->count == 0; }));
  EXPECT_EQ(contacts.all().back()->touching, std::vector<std::string>{"box"});
  place.request.model = "robot";
  place.request.pose.x = -3.0;
  ASSERT_TRUE(ros::service::call(name_ + "/place", place));
  EXPECT_TRUE(spinUntil([&] {
    return !truth.all().empty() && truth.all().back()->pose.pose.position.x < -2.9 &&
           contacts.all().back()->touching.empty();
  }));
  EXPECT_EQ(contacts.all().back()->count, 1U);
  place.request.model = "sofa";
  ASSERT_TRUE(ros::service::call(name_ + "/place", place));
  EXPECT_FALSE(place.response.ok);
  EXPECT_NE(place.response.message.find("sofa"), std::string::npos);
  std_srvs::Empty reset;
  ASSERT_TRUE(ros::service::call(name_ + "/reset", reset));
  EXPECT_TRUE(spinUntil([&] {
    return contacts.all().back()->count == 0 &&
           std::abs(truth.all().back()->pose.pose.position.x) < 0.01;
  })) << "as at the start";
}

TEST_F(SimulatorTest, FailsItsSensorsOnDemand) {
  Inbox<sensor_msgs::Range> front(handle_, "range/front");
  Inbox<nav_msgs::Odometry> odometry(handle_, "odom");
  ASSERT_TRUE(load());
  ASSERT_TRUE(front.waitFor(1));
  SimulatorFault fault;
  fault.request.sensor = "front";
  fault.request.kind = "corrupt";
  ASSERT_TRUE(ros::service::call(name_ + "/fault", fault));
  EXPECT_TRUE(fault.response.ok) << fault.response.message;
  EXPECT_TRUE(spinUntil([&] { return !(std::abs(front.all().back()->range) < 100.0F); }));
  fault.request.kind = "delay";
  fault.request.sensor = "odometry";
  fault.request.amount = 0.5F;
  ASSERT_TRUE(ros::service::call(name_ + "/fault", fault));
  ASSERT_TRUE(fault.response.ok);
  EXPECT_TRUE(spinUntil([&] {
    return (front.all().back()->header.stamp - odometry.all().back()->header.stamp).toSec() > 0.4;
  }));
  fault.request.kind = "sulk";
  ASSERT_TRUE(ros::service::call(name_ + "/fault", fault));
  EXPECT_FALSE(fault.response.ok);
  EXPECT_NE(fault.response.message.find("\"sulk\""), std::string::npos);
  fault.request.kind = "drop";
  fault.request.sensor = "nose";
  ASSERT_TRUE(ros::service::call(name_ + "/fault", fault));
  EXPECT_FALSE(fault.response.ok);
  EXPECT_NE(fault.response.message.find("\"nose\""), std::string::npos);
}

/// Everything logged as fatal since construction.
class FatalLog {
 public:
  FatalLog()
      : subscriber_(handle_.subscribe<rosgraph_msgs::Log>(
            "/rosout", 100, [this](const rosgraph_msgs::Log::ConstPtr& log) {
              if (log->level == rosgraph_msgs::Log::FATAL) text_ += log->msg + '\n';
            })) {
    spinUntil([this] { return subscriber_.getNumPublishers() > 0; });
  }
  bool waitFor(const std::string& part) {
    return spinUntil([&] { return text_.find(part) != std::string::npos; });
  }
  const std::string& text() const { return text_; }

 private:
  ros::NodeHandle handle_;
  std::string text_;
  ros::Subscriber subscriber_;
};

TEST_F(SimulatorTest, RefusesABadWorldWithItsLine) {
  const std::string path = ownFolder() + "/simulator_bad.sdf";
  std::ofstream(path) << "<?xml version='1.0'?>\n<sdf version='1.9'>\n<world name='test'>\n"
                      << "<model name='floor'>\n";
  handle_.setParam("simulator/world", path);
  FatalLog log;
  EXPECT_FALSE(load());
  EXPECT_TRUE(log.waitFor("world is " + path + ", which cannot be used: " + path + ":"))
      << log.text();
}

TEST_F(SimulatorTest, RefusesBadParameters) {
  FatalLog log;
  const auto refuse = [&](const std::string& key, const XmlRpc::XmlRpcValue& value,
                          const std::string& line) {
    handle_.setParam("simulator/" + key, value);
    EXPECT_FALSE(load()) << key;
    EXPECT_TRUE(log.waitFor(line)) << log.text();
    handle_.deleteParam("simulator/" + key);
  };
  refuse("camera", std::string("eye"), "camera is \"eye\"");
  refuse("seed", -1, "seed is -1");
  refuse("rate", 2.0, "rate is not 1");
  refuse("rate", std::nan(""), "rate is nan");
  refuse("clock", true, "clock is true");
  refuse("wrold", 1, "wrold is not a parameter here");
  refuse("depth_rate", 500.0, "depth_rate is 500");
  handle_.deleteParam("simulator/world");
  EXPECT_FALSE(load());
  EXPECT_TRUE(log.waitFor("world is missing")) << log.text();
}

}  // namespace
}  // namespace pilothouse

int main(int argc, char** argv) {
  ros::init(argc, argv, "test_simulator");
  testing::InitGoogleTest(&argc, argv);
  ros::NodeHandle keeps_ros_alive;
  return RUN_ALL_TESTS();
}
