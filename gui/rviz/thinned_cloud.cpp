#include "gui/rviz/thinned_cloud.hpp"

#include <ros/this_node.h>

#include "core/cloud/cloud_view.hpp"
#include "doors/message_views.hpp"
#include "gui/rviz/drawn_cloud.hpp"

namespace pilothouse::gui {

ThinnedCloud::ThinnedCloud(const std::string& from, const std::string& to) : spinner_(1, &queue_) {
  node_.setCallbackQueue(&queue_);
  // Below the node's own unique name, so that two consoles do not draw each other's clouds.
  publisher_ = node_.advertise<sensor_msgs::PointCloud2>(ros::this_node::getName() + "/" + to, 1);
  subscriber_ = subscribeDrawn(node_, from, [this](const auto& cloud) { receive(cloud); });
  spinner_.start();
}

void ThinnedCloud::receive(const sensor_msgs::PointCloud2ConstPtr& cloud) {
  const auto view = openView(*cloud);
  if (!view) return;  // nothing is drawn of what cannot be read
  const std::size_t step = view->points() / kMostPoints + 1;
  DrawnCloud thin(cloud->header, false);
  thin.reserve(view->points() / step + 1);
  for (std::size_t i = 0; i < view->points(); i += step) {
    const Eigen::Vector3f point = view->point(static_cast<std::uint32_t>(i / view->width()),
                                              static_cast<std::uint32_t>(i % view->width()));
    if (point.allFinite()) thin.add(point);
  }
  publisher_.publish(thin.finished());
}

}  // namespace pilothouse::gui
