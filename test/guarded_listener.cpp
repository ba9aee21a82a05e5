// Subscribes to points and tells what became of each cloud. With ~guarded false it does so as any
// node would, which shows what the guard is for.
#include <ros/ros.h>
#include <std_msgs/String.h>
#include <std_msgs/UInt32.h>

#include "doors/guarded_subscriber.hpp"

namespace {
constexpr std::uint32_t kQueue = 2000;  // all that a test sends: what a queue drops nobody answers
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "guarded_listener");
  ros::NodeHandle nh;
  ros::Publisher accepted = nh.advertise<std_msgs::UInt32>("accepted", kQueue);
  ros::Publisher refused = nh.advertise<std_msgs::String>("refused", kQueue);
  const boost::function<void(const sensor_msgs::PointCloud2ConstPtr&)> on_cloud =
      [&accepted](const sensor_msgs::PointCloud2ConstPtr& cloud) {
        std_msgs::UInt32 width;
        width.data = cloud->width;
        accepted.publish(width);
      };
  bool guarded = true;
  ros::NodeHandle("~").getParam("guarded", guarded);
  ros::Subscriber points = guarded
                               ? pilothouse::subscribeGuarded<sensor_msgs::PointCloud2>(
                                     nh, "points", kQueue, on_cloud,
                                     [&refused](const std::string& reason) {
                                       std_msgs::String text;
                                       text.data = reason;
                                       refused.publish(text);
                                     })
                               : nh.subscribe<sensor_msgs::PointCloud2>("points", kQueue, on_cloud);
  ros::spin();
  return 0;
}
