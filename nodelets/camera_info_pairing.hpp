#pragma once

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <deque>
#include <functional>

namespace pilothouse {

/// Finds the CameraInfo of each image: the one of exactly the same stamp; else the newest of the
/// same size and frame, since a camera's intrinsics rarely change and some drivers stamp the two
/// apart. An image for which no CameraInfo fits (yet) waits for the next one, at most one image.
class CameraInfoPairing {
 public:
  using Paired = std::function<void(const sensor_msgs::Image::ConstPtr&,
                                    const sensor_msgs::CameraInfo::ConstPtr&)>;
  using Unpaired = std::function<void(const sensor_msgs::Image::ConstPtr&)>;

  CameraInfoPairing(Paired paired, Unpaired unpaired)
      : paired_(std::move(paired)), unpaired_(std::move(unpaired)) {}

  void add(const sensor_msgs::Image::ConstPtr& image);
  void add(const sensor_msgs::CameraInfo::ConstPtr& info);
  void clear();

 private:
  static constexpr std::size_t kInfos = 8;
  sensor_msgs::CameraInfo::ConstPtr infoFor(const sensor_msgs::Image& image) const;

  Paired paired_;
  Unpaired unpaired_;
  std::deque<sensor_msgs::CameraInfo::ConstPtr> infos_;  ///< newest in front
  sensor_msgs::Image::ConstPtr waiting_;
};

}  // namespace pilothouse
