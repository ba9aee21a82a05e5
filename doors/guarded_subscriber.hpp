#pragma once

#include <nav_msgs/Path.h>
#include <pilothouse/FloorGrid.h>
#include <pilothouse/ObjectList.h>
#include <ros/node_handle.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>

#include <boost/make_shared.hpp>
#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

#include "core/cloud/message_bounds.hpp"
#include "core/cloud/wire_schema.hpp"

namespace pilothouse {

/// Where the lengths lie in a message of the kind. @throws std::logic_error where its definition
/// cannot be read, which is a fault of who generated it.
template <class Message>
const WireSchema& wireSchemaOf() {
  static const Checked<WireSchema> schema = WireSchema::parse(
      ros::message_traits::datatype<Message>(), ros::message_traits::definition<Message>());
  if (!schema) throw std::logic_error(schema.reason());
  return *schema;
}

/// The first length prefix that lies in the bytes of a message of the kind: by bounds of its own
/// for the large ones that sensors send, else by its definition.
template <class Message>
std::optional<LengthFault> lengthFault(const std::uint8_t* bytes, std::size_t size) {
  if constexpr (std::is_same_v<Message, sensor_msgs::PointCloud2>) {
    return pointCloud2Fault(bytes, size);
  } else if constexpr (std::is_same_v<Message, sensor_msgs::Image>) {
    return imageFault(bytes, size);
  } else if constexpr (std::is_same_v<Message, sensor_msgs::CompressedImage>) {
    return compressedImageFault(bytes, size);
  } else if constexpr (std::is_same_v<Message, sensor_msgs::CameraInfo>) {
    return cameraInfoFault(bytes, size);
  } else if constexpr (std::is_same_v<Message, FloorGrid>) {
    return floorGridFault(bytes, size);
  } else if constexpr (std::is_same_v<Message, ObjectList>) {
    return objectListFault(bytes, size);
  } else if constexpr (std::is_same_v<Message, nav_msgs::Path>) {
    return pathFault(bytes, size);
  } else {
    return wireSchemaOf<Message>().fault(bytes, size);
  }
}

/// Called with the reason of a refusal, in the thread that would have run the callback.
using OnRefused = std::function<void(const std::string& reason)>;

/// roscpp's own helper, except that bytes whose length prefixes lie are refused before anything is
/// allocated for them. Messages from the same process never come as bytes and pass untouched: the
/// type is still the message's, so the pointer stays the publisher's.
/// @tparam Parameter what the callback takes: a shared pointer to const, or a MessageEvent.
template <class Message, class Parameter>
class GuardedCallbackHelper : public ros::SubscriptionCallbackHelperT<Parameter> {
  using Plain = ros::SubscriptionCallbackHelperT<Parameter>;

 public:
  GuardedCallbackHelper(const typename Plain::Callback& callback, OnRefused on_refused)
      : Plain(callback), on_refused_(std::move(on_refused)) {
    lengthFault<Message>(nullptr, 0);  // a definition that cannot be read is told now
  }

  ros::VoidConstPtr deserialize(
      const ros::SubscriptionCallbackHelperDeserializeParams& params) override {
    const auto fault = lengthFault<Message>(params.buffer, params.length);
    if (!fault) return Plain::deserialize(params);
    on_refused_(describe(*fault));
    return {};  // roscpp skips the callback of a null message
  }

 private:
  OnRefused on_refused_;
};

/// What to give to ros::NodeHandle::subscribe for a topic that anyone may publish on, with a
/// callback that wants to know who sent it. roscpp deserialises once for all subscribers of a topic
/// in a process, by the helper of the first: each of them must be a guarded one.
/// @param on_refused counts and reports; required.
template <class Message>
ros::SubscribeOptions guardedOptions(
    const std::string& topic, std::uint32_t queue,
    const boost::function<void(const ros::MessageEvent<const Message>&)>& callback,
    OnRefused on_refused) {
  ros::SubscribeOptions options(topic, queue, ros::message_traits::md5sum<Message>(),
                                ros::message_traits::datatype<Message>());
  options.helper =
      boost::make_shared<GuardedCallbackHelper<Message, const ros::MessageEvent<const Message>&>>(
          callback, std::move(on_refused));
  return options;
}

/// As ros::NodeHandle::subscribe, for topics that anyone may publish on; the same holds.
template <class Message>
ros::Subscriber subscribeGuarded(
    ros::NodeHandle& nh, const std::string& topic, std::uint32_t queue,
    const boost::function<void(const boost::shared_ptr<const Message>&)>& callback,
    OnRefused on_refused, const ros::TransportHints& hints = ros::TransportHints()) {
  ros::SubscribeOptions options(topic, queue, ros::message_traits::md5sum<Message>(),
                                ros::message_traits::datatype<Message>());
  options.helper =
      boost::make_shared<GuardedCallbackHelper<Message, const boost::shared_ptr<const Message>&>>(
          callback, std::move(on_refused));
  options.transport_hints = hints;
  return nh.subscribe(options);
}

}  // namespace pilothouse
