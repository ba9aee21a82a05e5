#include <nodelet/nodelet.h>
#include <sensor_msgs/PointCloud2.h>
#include <pluginlib/class_list_macros.hpp>

#include "nodelets/floor_publisher.hpp"
#include "nodelets/message_views.hpp"

namespace pilothouse {

/// Judges the floor in camera/depth/points.
class CloudFloor : public nodelet::Nodelet {
  void onInit() override {
    ros::NodeHandle& handle = getNodeHandle();
    floor_ =
        std::make_unique<FloorPublisher>(handle, getPrivateNodeHandle(), "camera/depth/points");
    floor_->start([this, &handle](bool wanted) {
      if (wanted) {
        cloud_ = handle.subscribe("camera/depth/points", 1, &CloudFloor::take, this,
                                  ros::TransportHints().tcpNoDelay());
      } else {
        cloud_.shutdown();
      }
    });
  }

  void take(const sensor_msgs::PointCloud2::ConstPtr& cloud) {
    floor_->process(cloud->header, openView(*cloud));
  }

  std::unique_ptr<FloorPublisher> floor_;
  ros::Subscriber cloud_;
};

}  // namespace pilothouse

PLUGINLIB_EXPORT_CLASS(pilothouse::CloudFloor, nodelet::Nodelet)
