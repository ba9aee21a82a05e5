#pragma once

#include <ros/node_handle.h>

#include <functional>
#include <string>
#include <utility>

#include "doors/guarded_subscriber.hpp"

namespace pilothouse {

/// roscpp's own helper, except that a request whose length prefixes lie is refused before anything
/// is allocated for it: the caller's call fails.
template <class Request, class Response>
class GuardedServiceHelper
    : public ros::ServiceCallbackHelperT<ros::ServiceSpec<Request, Response>> {
  using Plain = ros::ServiceCallbackHelperT<ros::ServiceSpec<Request, Response>>;

 public:
  GuardedServiceHelper(const typename Plain::Callback& callback, OnRefused on_refused)
      : Plain(callback), on_refused_(std::move(on_refused)) {
    lengthFault<Request>(nullptr, 0);  // a definition that cannot be read is told now
  }

  bool call(ros::ServiceCallbackHelperCallParams& params) override {
    const ros::SerializedMessage& bytes = params.request;
    const auto head = static_cast<std::size_t>(bytes.message_start - bytes.buf.get());
    const auto fault = lengthFault<Request>(bytes.message_start, bytes.num_bytes - head);
    if (!fault) return Plain::call(params);
    on_refused_(describe(*fault));
    return false;
  }

 private:
  OnRefused on_refused_;
};

/// As ros::NodeHandle::advertiseService, for services that anyone may call.
template <class Service>
ros::ServiceServer advertiseGuarded(
    ros::NodeHandle& nh, const std::string& name,
    const boost::function<bool(typename Service::Request&, typename Service::Response&)>& callback,
    OnRefused on_refused) {
  using Request = typename Service::Request;
  using Response = typename Service::Response;
  ros::AdvertiseServiceOptions options;
  options.service = name;
  options.md5sum = ros::service_traits::md5sum<Service>();
  options.datatype = ros::service_traits::datatype<Service>();
  options.req_datatype = ros::message_traits::datatype<Request>();
  options.res_datatype = ros::message_traits::datatype<Response>();
  options.helper =
      boost::make_shared<GuardedServiceHelper<Request, Response>>(callback, std::move(on_refused));
  return nh.advertiseService(options);
}

}  // namespace pilothouse
