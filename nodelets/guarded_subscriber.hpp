#pragma once

#include <ros/node_handle.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>

#include <boost/make_shared.hpp>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "core/cloud/message_bounds.hpp"

namespace pilothouse {

inline std::optional<LengthFault> lengthFault(const sensor_msgs::PointCloud2*,
                                              const std::uint8_t* bytes, std::size_t size) {
  return pointCloud2Fault(bytes, size);
}
inline std::optional<LengthFault> lengthFault(const sensor_msgs::Image*, const std::uint8_t* bytes,
                                              std::size_t size) {
  return imageFault(bytes, size);
}
inline std::optional<LengthFault> lengthFault(const sensor_msgs::CompressedImage*,
                                              const std::uint8_t* bytes, std::size_t size) {
  return compressedImageFault(bytes, size);
}
inline std::optional<LengthFault> lengthFault(const sensor_msgs::CameraInfo*,
                                              const std::uint8_t* bytes, std::size_t size) {
  return cameraInfoFault(bytes, size);
}

/// Called with the reason of a refusal, in the thread that would have run the callback.
using OnRefused = std::function<void(const std::string& reason)>;

/// roscpp's own helper, except that bytes whose length prefixes lie are refused before anything is
/// allocated for them. Messages from the same process never come as bytes and pass untouched: the
/// type is still M's, so the pointer stays the publisher's.
template <class M>
class GuardedCallbackHelper
    : public ros::SubscriptionCallbackHelperT<const boost::shared_ptr<M const>&> {
  using Plain = ros::SubscriptionCallbackHelperT<const boost::shared_ptr<M const>&>;

 public:
  GuardedCallbackHelper(const typename Plain::Callback& callback, OnRefused on_refused)
      : Plain(callback), on_refused_(std::move(on_refused)) {}

  ros::VoidConstPtr deserialize(
      const ros::SubscriptionCallbackHelperDeserializeParams& params) override {
    const auto fault = lengthFault(static_cast<const M*>(nullptr), params.buffer, params.length);
    if (!fault) return Plain::deserialize(params);
    on_refused_(describe(*fault));
    return {};  // roscpp skips the callback of a null message
  }

 private:
  OnRefused on_refused_;
};

/// As ros::NodeHandle::subscribe, for topics that anyone may publish on. roscpp deserialises once
/// for all subscribers of a topic in a process, by the helper of the first: each of them in a
/// manager must come through here.
/// @param on_refused counts and reports; required.
template <class M>
ros::Subscriber subscribeGuarded(
    ros::NodeHandle& nh, const std::string& topic, std::uint32_t queue,
    const boost::function<void(const boost::shared_ptr<M const>&)>& callback, OnRefused on_refused,
    const ros::TransportHints& hints = ros::TransportHints()) {
  ros::SubscribeOptions options(topic, queue, ros::message_traits::md5sum<M>(),
                                ros::message_traits::datatype<M>());
  options.helper = boost::make_shared<GuardedCallbackHelper<M>>(callback, std::move(on_refused));
  options.transport_hints = hints;
  return nh.subscribe(options);
}

}  // namespace pilothouse
