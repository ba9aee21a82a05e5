#pragma once

#include <ros/subscribe_options.h>
#include <ros/subscription_callback_helper.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>

#include <boost/make_shared.hpp>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include "core/cloud/message_bounds.hpp"
#include "gui/model/floor_grid_message.hpp"
#include "pilothouse/ObjectList.h"

namespace pilothouse::gui {

/// Length prefixes that lie, in the bytes of one kind of message; other kinds are not looked at.
template <class Message>
std::optional<LengthFault> lengthFaultOf(const std::uint8_t* bytes, std::size_t size) {
  if constexpr (std::is_same_v<Message, sensor_msgs::PointCloud2>) {
    return pointCloud2Fault(bytes, size);
  } else if constexpr (std::is_same_v<Message, sensor_msgs::Image>) {
    return imageFault(bytes, size);
  } else if constexpr (std::is_same_v<Message, sensor_msgs::CompressedImage>) {
    return compressedImageFault(bytes, size);
  } else if constexpr (std::is_same_v<Message, sensor_msgs::CameraInfo>) {
    return cameraInfoFault(bytes, size);
  } else if constexpr (std::is_same_v<Message, FloorGridMessage>) {
    return floorGridFault(bytes, size);
  } else if constexpr (std::is_same_v<Message, ObjectList>) {
    return objectListFault(bytes, size);
  } else {
    static_cast<void>(bytes);
    static_cast<void>(size);
    return std::nullopt;
  }
}

/// roscpp's helper for callbacks that take the whole event, except that bytes whose length prefixes
/// lie are refused before roscpp allocates what they claim.
template <class Message>
class GuardedHelper
    : public ros::SubscriptionCallbackHelperT<const ros::MessageEvent<Message const>&> {
  using Plain = ros::SubscriptionCallbackHelperT<const ros::MessageEvent<Message const>&>;

 public:
  /// @param refused is told the reason, on the spinner's thread.
  GuardedHelper(const typename Plain::Callback& callback,
                std::function<void(const std::string&)> refused)
      : Plain(callback), refused_(std::move(refused)) {}

  ros::VoidConstPtr deserialize(
      const ros::SubscriptionCallbackHelperDeserializeParams& params) override {
    const auto fault = lengthFaultOf<Message>(params.buffer, params.length);
    if (!fault) return Plain::deserialize(params);
    refused_(describe(*fault));
    return {};  // roscpp skips the callback of a null message
  }

 private:
  std::function<void(const std::string&)> refused_;
};

/// What to give to ros::NodeHandle::subscribe for a topic that anyone may publish on. roscpp
/// deserialises once for all subscribers of a topic in a process, by the helper of the first: each
/// of them in the console must come through here.
template <class Message>
ros::SubscribeOptions guardedOptions(
    const std::string& topic, std::uint32_t queue,
    const boost::function<void(const ros::MessageEvent<const Message>&)>& receive,
    const std::function<void(const std::string&)>& refused) {
  ros::SubscribeOptions options(topic, queue, ros::message_traits::md5sum<Message>(),
                                ros::message_traits::datatype<Message>());
  options.helper = boost::make_shared<GuardedHelper<Message>>(receive, refused);
  return options;
}

}  // namespace pilothouse::gui
