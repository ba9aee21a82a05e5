#include "gui/rviz/thinned_cloud.hpp"

#include <ros/console.h>
#include <ros/this_node.h>

#include <cstring>
#include <vector>

#include "core/cloud/cloud_view.hpp"
#include "doors/guarded_subscriber.hpp"
#include "doors/message_views.hpp"

namespace pilothouse::gui {

ThinnedCloud::ThinnedCloud(const std::string& from, const std::string& to) : spinner_(1, &queue_) {
  node_.setCallbackQueue(&queue_);
  // Below the node's own unique name, so that two consoles do not draw each other's clouds.
  publisher_ = node_.advertise<sensor_msgs::PointCloud2>(ros::this_node::getName() + "/" + to, 1);
  using Cloud = sensor_msgs::PointCloud2;
  const std::string name = node_.resolveName(from);
  auto options = guardedOptions<Cloud>(
      from, 1,
      [this](const ros::MessageEvent<const Cloud>& event) { receive(event.getConstMessage()); },
      [name](const std::string& reason) {
        ROS_WARN_THROTTLE(5.0, "%s: %s; not drawn", name.c_str(), reason.c_str());
      });
  subscriber_ = node_.subscribe(options);
  spinner_.start();
}

void ThinnedCloud::receive(const sensor_msgs::PointCloud2ConstPtr& cloud) {
  const auto view = openView(*cloud);
  if (!view) return;  // nothing is drawn of what cannot be read
  const std::size_t step = view->points() / kMostPoints + 1;
  sensor_msgs::PointCloud2 thin;
  thin.header = cloud->header;
  thin.height = 1;
  thin.point_step = 12;
  thin.is_dense = false;
  const char* names[] = {"x", "y", "z"};
  for (std::uint32_t i = 0; i < 3; ++i) {
    sensor_msgs::PointField field;
    field.name = names[i];
    field.offset = 4 * i;
    field.datatype = sensor_msgs::PointField::FLOAT32;
    field.count = 1;
    thin.fields.push_back(field);
  }
  thin.data.reserve(12 * (view->points() / step + 1));
  for (std::size_t i = 0; i < view->points(); i += step) {
    const Eigen::Vector3f point = view->point(static_cast<std::uint32_t>(i / view->width()),
                                              static_cast<std::uint32_t>(i % view->width()));
    if (!point.allFinite()) continue;
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(point.data());
    thin.data.insert(thin.data.end(), bytes, bytes + 12);
    ++thin.width;
  }
  thin.row_step = thin.width * thin.point_step;
  publisher_.publish(thin);
}

}  // namespace pilothouse::gui
