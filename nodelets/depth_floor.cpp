#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include "doors/guarded_subscriber.hpp"
#include "doors/message_views.hpp"
#include "nodelets/camera_info_pairing.hpp"
#include "nodelets/floor_publisher.hpp"

namespace pilothouse {

/// Judges the floor in camera/depth/image_rect with the help of camera/depth/camera_info.
class DepthFloor : public nodelet::Nodelet {
  void onInit() override {
    floor_ = std::make_unique<FloorPublisher>(getNodeHandle(), getPrivateNodeHandle(),
                                              "camera/depth/image_rect");
    floor_->start([this](bool wanted) { wanted ? listen() : ignore(); });
  }

  void listen() {
    const auto hints = ros::TransportHints().tcpNoDelay();
    ros::NodeHandle& handle = getNodeHandle();
    const auto refused = [this](const std::string& reason) { floor_->reject("lengths", reason); };
    info_ = subscribeGuarded<sensor_msgs::CameraInfo>(
        handle, "camera/depth/camera_info", 8,
        [this](const sensor_msgs::CameraInfo::ConstPtr& info) { pairing_.add(info); }, refused,
        hints);
    image_ = subscribeGuarded<sensor_msgs::Image>(
        handle, "camera/depth/image_rect", 1,
        [this](const sensor_msgs::Image::ConstPtr& image) { pairing_.add(image); }, refused, hints);
  }

  void ignore() {
    image_.shutdown();
    info_.shutdown();
    pairing_.clear();
  }

  CameraInfoPairing pairing_{[this](const sensor_msgs::Image::ConstPtr& image,
                                    const sensor_msgs::CameraInfo::ConstPtr& info) {
                               floor_->process(image->header, openView(*image, *info));
                             },
                             [this](const sensor_msgs::Image::ConstPtr& image) {
                               floor_->reject("no camera info",
                                              "no CameraInfo of the same stamp, nor one of " +
                                                  std::to_string(image->width) + "x" +
                                                  std::to_string(image->height) + " in frame \"" +
                                                  image->header.frame_id + "\"");
                             }};
  std::unique_ptr<FloorPublisher> floor_;
  ros::Subscriber info_, image_;
};

}  // namespace pilothouse

PLUGINLIB_EXPORT_CLASS(pilothouse::DepthFloor, nodelet::Nodelet)
