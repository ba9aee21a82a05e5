#pragma once

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>
#include <visualization_msgs/Marker.h>

#include <Eigen/Geometry>
#include <mutex>
#include <string>

#include "nodelets/kept_file.hpp"
#include "volume/volume_map.hpp"

namespace pilothouse {

struct VolumeKeeperSettings {
  VolumeParameters volume;
  std::string folder;  ///< of all maps
  std::string name;    ///< of the .bt that is loaded at the start and saved by itself; empty: none
};

/// The octree in use with its files (NAME.bt in a folder). Any thread may call any function.
class VolumeKeeper {
 public:
  /// Loads the octree of the settings, where there is one. A bad one is told by fault(), and is not
  /// written over until one was saved or loaded by hand.
  explicit VolumeKeeper(const VolumeKeeperSettings& settings);

  /// @return why it was refused; empty: it was not.
  std::string add(const sensor_msgs::Image& image, const sensor_msgs::CameraInfo& info,
                  const Eigen::Isometry3d& T_map_optical);
  /// @param name empty: that of the settings. @return what was done. @throws std::runtime_error
  /// with the reason; then files or octree are as they were.
  std::string save(const std::string& name);
  std::string load(const std::string& name);
  void clear();
  /// Saves the octree of the settings where it has changed since it was saved.
  void saveByItself();
  VolumeMap::Report report() const;
  std::string fault() const;  ///< of the files; empty: none

  /// Middles of the occupied leaves, as points with their edge as `size`, and as cubes for rviz,
  /// coloured by height. At most `most` of them; the rest is told by report().
  sensor_msgs::PointCloud2::Ptr points(const std_msgs::Header& header, std::size_t most) const;
  visualization_msgs::Marker::Ptr cubes(const std_msgs::Header& header, std::size_t most) const;

 private:
  std::string pathOf(const std::string& name) const;

  std::uint64_t version() const { return version_ + volume_.changes(); }

  std::string folder_;
  mutable std::mutex mutex_;  ///< guards the octree and what goes with it
  std::mutex files_;          ///< one writer at a time; taken before the other
  VolumeMap volume_;
  std::uint64_t version_ = 0;  ///< of the octrees that came before this one
  KeptFile kept_;
};

}  // namespace pilothouse
