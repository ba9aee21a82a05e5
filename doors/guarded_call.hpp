#pragma once

#include <ros/service_client.h>

#include <stdexcept>
#include <string>

#include "doors/guarded_subscriber.hpp"

namespace pilothouse {

/// A service's response whose length prefixes are looked at before anything is allocated for it.
template <class Response>
struct GuardedResponse {
  Response message;
};

/// Calls a service that anyone may offer. @return why there is no response; empty: there is one.
/// Waits for the answer however long that takes: never on a thread that others wait for.
template <class Service>
std::string callGuarded(ros::ServiceClient& client, typename Service::Request& request,
                        typename Service::Response& response) {
  GuardedResponse<typename Service::Response> guarded;
  if (!client.isValid() || !client.exists()) return "no service " + client.getService();
  if (!client.call(request, guarded, std::string(ros::service_traits::md5sum<Service>()))) {
    return client.getService() + " failed";
  }
  response = std::move(guarded.message);
  return {};
}

}  // namespace pilothouse

namespace ros {
namespace serialization {

template <class Response>
struct Serializer<pilothouse::GuardedResponse<Response>> {
  template <class Stream>
  static void read(Stream& stream, pilothouse::GuardedResponse<Response>& response) {
    // roscpp takes what is thrown here for a response that cannot be read: the call fails.
    if (const auto fault = pilothouse::lengthFault<Response>(stream.getData(), stream.getLength()))
      throw std::runtime_error(pilothouse::describe(*fault));
    Serializer<Response>::read(stream, response.message);
  }
};

}  // namespace serialization
}  // namespace ros
