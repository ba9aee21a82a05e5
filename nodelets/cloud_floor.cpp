#include <nodelet/nodelet.h>
#include <sensor_msgs/PointCloud2.h>
#include <pluginlib/class_list_macros.hpp>

#include "doors/guarded_subscriber.hpp"
#include "doors/message_views.hpp"
#include "nodelets/floor_publisher.hpp"

namespace pilothouse {

/// Judges the floor in camera/depth/points.
class CloudFloor : public nodelet::Nodelet {
  void onInit() override {
    ros::NodeHandle& handle = getNodeHandle();
    floor_ =
        std::make_unique<FloorPublisher>(handle, getPrivateNodeHandle(), "camera/depth/points");
    floor_->start([this, &handle](bool wanted) {
      if (wanted) {
        cloud_ = subscribeGuarded<sensor_msgs::PointCloud2>(
            handle, "camera/depth/points", 1,
            [this](const sensor_msgs::PointCloud2::ConstPtr& cloud) {
              floor_->process(cloud->header, openView(*cloud));
            },
            [this](const std::string& reason) { floor_->reject("lengths", reason); },
            ros::TransportHints().tcpNoDelay());
      } else {
        cloud_.shutdown();
      }
    });
  }

  std::unique_ptr<FloorPublisher> floor_;
  ros::Subscriber cloud_;
};

}  // namespace pilothouse

PLUGINLIB_EXPORT_CLASS(pilothouse::CloudFloor, nodelet::Nodelet)
