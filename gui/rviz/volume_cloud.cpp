#include "gui/rviz/volume_cloud.hpp"

#include <ros/this_node.h>

#include <limits>

#include "doors/message_views.hpp"
#include "gui/model/volume_boxes.hpp"
#include "gui/rviz/drawn_cloud.hpp"

namespace pilothouse::gui {

namespace {

constexpr float kUsualEdge = 0.05F;  // where nobody tells [m]

/// The least `size` of its points: what the door checks and reads as x is that field here.
float finestEdge(const sensor_msgs::PointCloud2& cloud) {
  sensor_msgs::PointCloud2 sizes = cloud;
  for (auto& field : sizes.fields) {
    if (field.name == "x") field.name = "was x";
    if (field.name == "size") field.name = "x";
  }
  const auto view = openView(sizes);
  float finest = std::numeric_limits<float>::infinity();
  if (!view) return kUsualEdge;
  for (std::uint32_t row = 0; row < view->height(); ++row) {
    for (std::uint32_t column = 0; column < view->width(); ++column) {
      const float size = view->point(row, column).x();
      if (size > 0.0F && size < finest) finest = size;
    }
  }
  return finest < 10.0F ? finest : kUsualEdge;
}

}  // namespace

VolumeCloud::VolumeCloud() : spinner_(1, &queue_) {
  node_.setCallbackQueue(&queue_);
  publisher_ = node_.advertise<sensor_msgs::PointCloud2>(
      ros::this_node::getName() + "/console_scene/volume", 1, true);
  subscriber_ =
      subscribeDrawn(node_, "volume_points", [this](const auto& cloud) { receive(cloud); });
  spinner_.start();
}

VolumeCloud::State VolumeCloud::state() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return state_;
}

void VolumeCloud::receive(const sensor_msgs::PointCloud2ConstPtr& cloud) {
  const auto view = openView(*cloud);
  if (!view) return;  // nothing is drawn of what cannot be read
  const VolumeBoxes boxes = boxesOf(*view, finestEdge(*cloud), kMostBoxes);
  DrawnCloud drawn(cloud->header, true);
  drawn.reserve(boxes.middles.size());
  for (const auto& middle : boxes.middles) {
    drawn.add(middle, colourOfHeight(ramp_, middle.z()) & 0xFFFFFFU);
  }
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    state_ = {cloud->header.frame_id, boxes.edge};
  }
  publisher_.publish(drawn.finished());
}

}  // namespace pilothouse::gui
