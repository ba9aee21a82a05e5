#include "gui/model/master.hpp"

#include <ros/master.h>
#include <ros/this_node.h>

namespace pilothouse::gui {

namespace {

// The parameter, or an invalid value.
XmlRpc::XmlRpcValue parameter(const std::string& name) {
  XmlRpc::XmlRpcValue arguments, result, payload;
  arguments[0] = ros::this_node::getName();
  arguments[1] = name;
  const bool found = ros::master::execute("getParam", arguments, result, payload, false);
  return found ? payload : XmlRpc::XmlRpcValue();
}

}  // namespace

std::string masterText(const std::string& name) {
  XmlRpc::XmlRpcValue value = parameter(name);
  const bool text = value.getType() == XmlRpc::XmlRpcValue::TypeString;
  return text ? static_cast<std::string>(value) : std::string();
}

bool masterFlag(const std::string& name) {
  XmlRpc::XmlRpcValue value = parameter(name);
  return value.getType() == XmlRpc::XmlRpcValue::TypeBoolean && static_cast<bool>(value);
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
