// A message from the same process must reach a guarded subscriber as the very object published.
#include "doors/guarded_subscriber.hpp"

#include <gtest/gtest.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <vector>

namespace pilothouse {
namespace {

/// Runs callbacks until `done` or the deadline.
template <class Condition>
bool spinUntil(Condition done) {
  const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(60.0);
  while (!done() && ros::WallTime::now() < deadline)
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.1));
  return done();
}

template <class M>
void expectSameObject(const std::string& topic) {
  ros::NodeHandle nh;
  std::vector<const M*> seen;
  const boost::function<void(const boost::shared_ptr<M const>&)> keep =
      [&seen](const boost::shared_ptr<M const>& message) { seen.push_back(message.get()); };
  const OnRefused refused = [](const std::string& reason) { FAIL() << reason; };
  ros::Subscriber first = subscribeGuarded<M>(nh, topic, 1, keep, refused);
  ros::Subscriber second = subscribeGuarded<M>(nh, topic, 1, keep, refused);
  ros::Publisher publisher = nh.advertise<M>(topic, 1);
  ASSERT_TRUE(spinUntil([&] { return publisher.getNumSubscribers() == 1; }));
  const auto message = boost::make_shared<M>();
  publisher.publish(message);
  ASSERT_TRUE(spinUntil([&] { return seen.size() == 2; }));
  EXPECT_EQ(seen[0], message.get());
  EXPECT_EQ(seen[1], message.get());
}

TEST(GuardedSubscriber, CloudsOfTheSameProcessAreNotCopied) {
  expectSameObject<sensor_msgs::PointCloud2>("own_points");
}
TEST(GuardedSubscriber, ImagesOfTheSameProcessAreNotCopied) {
  expectSameObject<sensor_msgs::Image>("own_image");
}
TEST(GuardedSubscriber, CameraInfosOfTheSameProcessAreNotCopied) {
  expectSameObject<sensor_msgs::CameraInfo>("own_info");
}

}  // namespace
}  // namespace pilothouse

int main(int argc, char** argv) {
  ros::init(argc, argv, "test_guarded_subscriber");
  testing::InitGoogleTest(&argc, argv);
  ros::Time::init();
  ros::NodeHandle keeps_ros_alive;
  return RUN_ALL_TESTS();
}
