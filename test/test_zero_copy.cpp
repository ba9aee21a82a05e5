// From the camera's publisher to the last subscriber every picture and every grid stays one object
// at one address, and nobody changes it. The relay beside this test (zero_copy.test) is a process
// of its own and so copies: the same check must condemn it, or it could not fail.
#include <gtest/gtest.h>
#include <ros/network.h>
#include <ros/serialization.h>
#include <ros/xmlrpc_manager.h>
#include <xmlrpcpp/XmlRpcClient.h>

#include "test/floor_harness.hpp"

namespace pilothouse {
namespace {

/// FNV-1a over the message as it would go over the wire.
template <class M>
std::uint64_t hashOf(const M& message) {
  const ros::SerializedMessage bytes = ros::serialization::serializeMessage(message);
  std::uint64_t hash = 1469598103934665603ULL;
  for (std::size_t i = 0; i < bytes.num_bytes; ++i) hash = (hash ^ bytes.buf[i]) * 1099511628211ULL;
  return hash;
}

/// Keeps every message of a topic alive, with the hash of what it held on arrival.
template <class M>
class Witness {
 public:
  Witness(ros::NodeHandle& handle, const std::string& topic)
      : subscriber_(
            handle.subscribe<M>(topic, 1000, [this](const boost::shared_ptr<M const>& message) {
              messages.push_back(message);
              hashes.push_back(hashOf(*message));
            })) {}
  std::vector<boost::shared_ptr<M const>> messages;
  std::vector<std::uint64_t> hashes;

 private:
  ros::Subscriber subscriber_;
};

/// How many messages arrived at another address than they were published from.
template <class M>
int copies(const std::vector<boost::shared_ptr<M const>>& published, const Witness<M>& witness) {
  int moved = 0;
  for (std::size_t i = 0; i < witness.messages.size(); ++i) {
    if (i >= published.size() || witness.messages[i].get() != published[i].get()) ++moved;
  }
  return moved;
}

template <class M>
int changed(const Witness<M>& witness) {
  int count = 0;
  for (std::size_t i = 0; i < witness.messages.size(); ++i) {
    if (hashOf(*witness.messages[i]) != witness.hashes[i]) ++count;
  }
  return count;
}

/// How this process is joined to the topic: one entry a connection, INTRAPROCESS or TCPROS.
std::vector<std::string> transportsOf(const std::string& topic) {
  std::string host;
  std::uint32_t port = 0;
  ros::network::splitURI(ros::XMLRPCManager::instance()->getServerURI(), host, port);
  XmlRpc::XmlRpcClient self(host.c_str(), static_cast<int>(port), "/");
  XmlRpc::XmlRpcValue request, answer;
  request[0] = ros::this_node::getName();
  EXPECT_TRUE(self.execute("getBusInfo", request, answer));
  XmlRpc::XmlRpcValue& connections = answer[2];
  std::vector<std::string> transports;
  for (int i = 0; i < connections.size(); ++i) {
    if (static_cast<std::string&>(connections[i][4]) == topic) {
      transports.push_back(static_cast<std::string&>(connections[i][3]));
    }
  }
  return transports;
}

template <class M>
void expectOneObjectAllTheWay(FloorHarness& harness, const std::string& camera_topic,
                              const std::function<boost::shared_ptr<M>(double)>& picture,
                              const std::function<void(double)>& before_each) {
  constexpr std::size_t kFrames = 60;
  ASSERT_TRUE(harness.load());
  Witness<FloorGrid> grids(harness.handle(), "floor_grid");
  ASSERT_TRUE(harness.waitForListener());
  // The last subscriber of the camera comes after the nodelet.
  Witness<M> last(harness.handle(), camera_topic);
  Witness<FloorGrid> last_grids(harness.handle(), "floor_grid");
  Witness<ObjectList> objects(harness.handle(), "objects/camera");
  Witness<sensor_msgs::PointCloud2> points(harness.handle(), "obstacle_points");

  std::vector<boost::shared_ptr<M const>> published;
  std::vector<std::uint64_t> hashes;
  while (published.size() < kFrames) {
    const double stamp = 100.0 + 0.1 * static_cast<double>(published.size());
    before_each(stamp);
    const boost::shared_ptr<M> message = picture(stamp);
    published.push_back(message);
    hashes.push_back(hashOf(*message));
    const std::size_t judged = grids.messages.size();
    harness.publish(message);
    ASSERT_TRUE(spinUntil([&] { return last.messages.size() == published.size(); }));
    // The first may come before the transform; from then on each is judged.
    if (!spinUntil([&] { return grids.messages.size() > judged; }, judged == 0 ? 0.2 : 30.0)) {
      ASSERT_EQ(judged, 0U) << "a picture got lost";
    }
  }
  ASSERT_TRUE(spinUntil([&] {
    return grids.messages.size() > kFrames / 2 &&
           last_grids.messages.size() == grids.messages.size() && objects.messages.size() > 10 &&
           points.messages.size() > 10;
  }));

  EXPECT_EQ(copies(published, last), 0);
  for (std::size_t i = 0; i < published.size(); ++i) {
    EXPECT_EQ(hashOf(*published[i]), hashes[i]) << "the camera's message was changed";
  }
  EXPECT_EQ(copies(grids.messages, last_grids), 0);
  EXPECT_EQ(changed(grids), 0);
  EXPECT_EQ(changed(last_grids), 0);
  EXPECT_EQ(changed(objects), 0);
  EXPECT_EQ(changed(points), 0);
  for (std::size_t i = 1; i < grids.messages.size(); ++i) {
    EXPECT_NE(grids.messages[i].get(), grids.messages[i - 1].get()) << "a message was used again";
  }
  for (const std::string& topic : {camera_topic, std::string("floor_grid")}) {
    const auto transports = transportsOf(harness.handle().resolveName(topic));
    EXPECT_FALSE(transports.empty()) << topic;
    for (const auto& transport : transports) EXPECT_EQ(transport, "INTRAPROCESS") << topic;
  }
}

TEST(ZeroCopy, ADepthImageAndItsGridAreOneObjectAllTheWay) {
  FloorHarness harness("DepthFloor");
  const BoxScene scene;
  expectOneObjectAllTheWay<sensor_msgs::Image>(
      harness, "camera/depth/image_rect", [&](double stamp) { return scene.image(stamp); },
      [&](double stamp) { harness.publish(scene.info(stamp)); });
}

TEST(ZeroCopy, ACloudAndItsGridAreOneObjectAllTheWay) {
  FloorHarness harness("CloudFloor");
  const BoxScene scene;
  expectOneObjectAllTheWay<sensor_msgs::PointCloud2>(
      harness, "camera/depth/points", [&](double stamp) { return scene.cloud(stamp); },
      [](double) {});
}

TEST(ZeroCopy, TheCheckCondemnsACopyOverTcp) {
  ros::NodeHandle handle;
  const BoxScene scene;
  ros::Publisher camera = handle.advertise<sensor_msgs::Image>("copied/in", 10);
  Witness<sensor_msgs::Image> relayed(handle, "copied/out");
  std::vector<boost::shared_ptr<sensor_msgs::Image const>> published;
  ASSERT_TRUE(spinUntil([&] {
    if (camera.getNumSubscribers() == 0) return false;
    published.push_back(scene.image(1.0));
    camera.publish(published.back());
    return !relayed.messages.empty();
  })) << "no relay from copied/in to copied/out";
  EXPECT_EQ(copies(published, relayed), static_cast<int>(relayed.messages.size()));
  const auto transports = transportsOf(handle.resolveName("copied/out"));
  ASSERT_FALSE(transports.empty());
  EXPECT_EQ(transports[0], "TCPROS");
}

TEST(ZeroCopy, TheCheckCondemnsAChangeAfterPublishing) {
  ros::NodeHandle handle;
  const BoxScene scene;
  ros::Publisher camera = handle.advertise<sensor_msgs::Image>("changed", 10);
  Witness<sensor_msgs::Image> witness(handle, "changed");
  ASSERT_TRUE(spinUntil([&] { return camera.getNumSubscribers() > 0; }));
  const auto message = scene.image(1.0);
  camera.publish(message);
  ASSERT_TRUE(spinUntil([&] { return witness.messages.size() == 1; }));
  EXPECT_EQ(changed(witness), 0);
  message->data[1000] ^= 1;
  EXPECT_EQ(changed(witness), 1);
}

}  // namespace
}  // namespace pilothouse

int main(int argc, char** argv) {
  ros::init(argc, argv, "test_zero_copy");
  testing::InitGoogleTest(&argc, argv);
  ros::NodeHandle keeps_ros_alive;
  const auto camera = pilothouse::broadcastCamera();
  return RUN_ALL_TESTS();
}
