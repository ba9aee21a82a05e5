#include "bench/node_process.hpp"

#include <ros/master.h>
#include <ros/network.h>
#include <ros/this_node.h>
#include <xmlrpcpp/XmlRpcClient.h>

namespace pilothouse::bench {

pid_t processOf(const std::string& node) {
  XmlRpc::XmlRpcValue question, answer, uri;
  question[0] = ros::this_node::getName();
  question[1] = node;
  if (!ros::master::execute("lookupNode", question, answer, uri, false)) return 0;
  std::string host;
  std::uint32_t port = 0;
  if (!ros::network::splitURI(static_cast<std::string>(uri), host, port)) return 0;
  XmlRpc::XmlRpcClient client(host.c_str(), static_cast<int>(port));
  XmlRpc::XmlRpcValue caller;
  caller[0] = ros::this_node::getName();
  if (!client.execute("getPid", caller, answer) || client.isFault()) return 0;
  if (answer.getType() != XmlRpc::XmlRpcValue::TypeArray || answer.size() != 3) return 0;
  return static_cast<int>(answer[2]);
}

}  // namespace pilothouse::bench
