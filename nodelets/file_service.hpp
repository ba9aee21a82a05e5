#pragma once

#include <pilothouse/MapFile.h>
#include <ros/node_handle.h>
#include <std_srvs/Trigger.h>

#include <functional>
#include <stdexcept>
#include <string>

namespace pilothouse {

template <class Response, class Work>
bool answer(Response& response, Work work) {
  try {
    response.message = work();
    response.success = true;
  } catch (const std::runtime_error& fault) {
    response.message = fault.what();
  }
  return true;
}

/// Offers a service that does something with the file of a name. @param work returns what it did,
/// or throws std::runtime_error with the reason.
inline ros::ServiceServer offerFile(ros::NodeHandle& handle, const std::string& service,
                                    const std::function<std::string(const std::string&)>& work) {
  return handle.advertiseService<MapFile::Request, MapFile::Response>(
      service, [work](MapFile::Request& request, MapFile::Response& response) {
        return answer(response, [&] { return work(request.name); });
      });
}

/// And one that does something without.
inline ros::ServiceServer offerTrigger(ros::NodeHandle& handle, const std::string& service,
                                       const std::function<std::string()>& work) {
  using Trigger = std_srvs::Trigger;
  return handle.advertiseService<Trigger::Request, Trigger::Response>(
      service,
      [work](Trigger::Request&, Trigger::Response& response) { return answer(response, work); });
}

}  // namespace pilothouse
