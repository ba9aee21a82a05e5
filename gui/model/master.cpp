#include "gui/model/master.hpp"

#include <ros/master.h>
#include <ros/this_node.h>

namespace pilothouse::gui {

std::string masterText(const std::string& name) {
  XmlRpc::XmlRpcValue arguments, result, payload;
  arguments[0] = ros::this_node::getName();
  arguments[1] = name;
  const bool found = ros::master::execute("getParam", arguments, result, payload, false) &&
                     payload.getType() == XmlRpc::XmlRpcValue::TypeString;
  return found ? static_cast<std::string>(payload) : std::string();
}

std::string masterIdentity() {
  XmlRpc::XmlRpcValue arguments, result, payload;
  arguments[0] = ros::this_node::getName();
  if (!ros::master::execute("getPid", arguments, result, payload, false)) return {};
  const std::string process = payload.getType() == XmlRpc::XmlRpcValue::TypeInt
                                  ? std::to_string(static_cast<int>(payload))
                                  : "unknown";
  return process + " " + masterText("/run_id");
}

}  // namespace pilothouse::gui
