#include "nodelets/camera_info_pairing.hpp"

namespace pilothouse {

sensor_msgs::CameraInfo::ConstPtr CameraInfoPairing::infoFor(
    const sensor_msgs::Image& image) const {
  for (const auto& info : infos_) {
    if (info->header.stamp == image.header.stamp) return info;
  }
  for (const auto& info : infos_) {
    if (info->width == image.width && info->height == image.height &&
        info->header.frame_id == image.header.frame_id) {
      return info;
    }
  }
  return nullptr;
}

void CameraInfoPairing::add(const sensor_msgs::Image::ConstPtr& image) {
  if (waiting_) unpaired_(waiting_);
  waiting_.reset();
  const auto info = infoFor(*image);
  if (info) {
    paired_(image, info);
  } else {
    waiting_ = image;
  }
}

void CameraInfoPairing::add(const sensor_msgs::CameraInfo::ConstPtr& info) {
  infos_.push_front(info);
  if (infos_.size() > kInfos) infos_.pop_back();
  if (!waiting_) return;
  const auto fitting = infoFor(*waiting_);
  if (!fitting) return;
  const auto image = std::move(waiting_);
  waiting_.reset();
  paired_(image, fitting);
}

void CameraInfoPairing::clear() {
  infos_.clear();
  waiting_.reset();
}

}  // namespace pilothouse
