#include "gui/rviz/drawn_cloud.hpp"

#include <ros/console.h>

#include "doors/guarded_subscriber.hpp"

namespace pilothouse::gui {

DrawnCloud::DrawnCloud(const std_msgs::Header& header, bool coloured) {
  cloud_.header = header;
  cloud_.height = 1;
  cloud_.is_dense = 0;
  for (const char* name : {"x", "y", "z", "rgb"}) {
    if (cloud_.point_step == 12 && !coloured) break;
    sensor_msgs::PointField field;
    field.name = name;
    field.offset = cloud_.point_step;
    field.datatype = sensor_msgs::PointField::FLOAT32;
    field.count = 1;
    cloud_.fields.push_back(field);
    cloud_.point_step += 4;
  }
}

sensor_msgs::PointCloud2& DrawnCloud::finished() {
  cloud_.row_step = cloud_.width * cloud_.point_step;
  return cloud_;
}

ros::Subscriber subscribeDrawn(
    ros::NodeHandle& node, const std::string& topic,
    const std::function<void(const sensor_msgs::PointCloud2ConstPtr&)>& take) {
  using Cloud = sensor_msgs::PointCloud2;
  const std::string name = node.resolveName(topic);
  auto options = guardedOptions<Cloud>(
      topic, 1,
      [take](const ros::MessageEvent<const Cloud>& event) { take(event.getConstMessage()); },
      [name](const std::string& reason) {
        ROS_WARN_THROTTLE(5.0, "%s: %s; not drawn", name.c_str(), reason.c_str());
      });
  return node.subscribe(options);
}

}  // namespace pilothouse::gui
