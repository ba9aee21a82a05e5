#pragma once

#include <ros/node_handle.h>
#include <sensor_msgs/PointCloud2.h>

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <string>

namespace pilothouse::gui {

/// Clouds as librviz takes them: x y z, and with a colour rgb, packed one after the other.
class DrawnCloud {
 public:
  DrawnCloud(const std_msgs::Header& header, bool coloured);
  void reserve(std::size_t points) { cloud_.data.reserve(points * cloud_.point_step); }
  void add(const Eigen::Vector3f& point) {
    put(point.data(), 12);
    cloud_.width += 1;
  }
  /// @param rgb 0xRRGGBB; of a coloured cloud.
  void add(const Eigen::Vector3f& point, std::uint32_t rgb) {
    add(point);
    put(&rgb, 4);
  }
  sensor_msgs::PointCloud2& finished();

 private:
  void put(const void* bytes, std::size_t size) {
    const auto* begin = static_cast<const std::uint8_t*>(bytes);
    cloud_.data.insert(cloud_.data.end(), begin, begin + size);
  }

  sensor_msgs::PointCloud2 cloud_;
};

/// Subscribes to another's clouds, refusing those whose lengths lie.
ros::Subscriber subscribeDrawn(
    ros::NodeHandle& node, const std::string& topic,
    const std::function<void(const sensor_msgs::PointCloud2ConstPtr&)>& take);

}  // namespace pilothouse::gui
