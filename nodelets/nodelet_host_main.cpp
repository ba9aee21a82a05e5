// A nodelet manager that loads its nodelets by itself: those of ~nodelets, name: type. With
// --respawn it is started again when it ends unasked, but not where it refuses what it is asked; it
// is complete at once, without loaders whose bonds take seconds to break and which a busy computer
// or a jump of time breaks for nothing.
#include <nodelet/loader.h>
#include <ros/ros.h>

#include <cstdio>
#include <cstdlib>

#include "doors/respawned.hpp"
#include "doors/strict_parameters.hpp"

namespace {

using pilothouse::StrictParameters;

/// Name and type of each nodelet. @throws ParameterFault.
std::map<std::string, std::string> readNodelets() {
  StrictParameters own(ros::NodeHandle("~"));
  int threads = 0;
  own.require({"nodelets"});
  own.read("num_worker_threads", threads, 0, 64);  // the loader's own
  XmlRpc::XmlRpcValue list = own.raw("nodelets");
  StrictParameters nodelets = own.child("nodelets");
  std::map<std::string, std::string> found;
  if (list.getType() == XmlRpc::XmlRpcValue::TypeStruct) {
    for (auto& entry : list) {
      std::string type;
      nodelets.read(entry.first, type);
      found[ros::names::resolve(entry.first)] = type;
    }
  }
  own.merge(nodelets);
  own.finish();
  return found;
}

/// The nodelets that were loaded already run: none of them is taken apart beneath its threads.
[[noreturn]] void refuse() {
  ros::shutdown();
  std::fflush(nullptr);
  std::_Exit(pilothouse::kRefused);
}

int load() {
  nodelet::Loader loader(ros::NodeHandle("~"));
  for (const auto& [name, type] : readNodelets()) {
    if (loader.load(name, type, ros::M_string(), nodelet::V_string())) continue;
    ROS_FATAL("Cannot load %s as %s: the reason stands above", type.c_str(), name.c_str());
    refuse();
  }
  ros::spin();
  return 0;
}

int run(int argc, char** argv) {
  ros::init(argc, argv, "nodelet_host");
  try {
    return load();
  } catch (const pilothouse::ParameterFault&) {
    return pilothouse::kRefused;  // each fault was logged
  }
}

}  // namespace

int main(int argc, char** argv) {
  return pilothouse::runRespawned(argc, argv, [&] { return run(argc, argv); });
}
