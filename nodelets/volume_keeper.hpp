#pragma once

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>
#include <visualization_msgs/Marker.h>

#include <Eigen/Geometry>
#include <mutex>
#include <string>

#include "volume/volume_map.hpp"

namespace pilothouse {

/// The octree in use with its files (NAME.bt in a folder). Any thread may call any function.
class VolumeKeeper {
 public:
  VolumeKeeper(const VolumeParameters& parameters, std::string folder)
      : folder_(std::move(folder)), volume_(parameters) {}

  /// @return why it was refused; empty: it was not.
  std::string add(const sensor_msgs::Image& image, const sensor_msgs::CameraInfo& info,
                  const Eigen::Isometry3d& T_map_optical);
  /// @return what was done. @throws std::runtime_error with the reason; then files or octree are as
  /// they were.
  std::string save(const std::string& name);
  std::string load(const std::string& name);
  void clear();
  VolumeMap::Report report() const;

  /// Middles of the occupied leaves, as points with their edge as `size`, and as cubes for rviz,
  /// coloured by height. At most `most` of them; the rest is told by report().
  sensor_msgs::PointCloud2::Ptr points(const std_msgs::Header& header, std::size_t most) const;
  visualization_msgs::Marker::Ptr cubes(const std_msgs::Header& header, std::size_t most) const;

 private:
  std::string pathOf(const std::string& name) const;

  std::string folder_;
  mutable std::mutex mutex_;
  VolumeMap volume_;
};

}  // namespace pilothouse
