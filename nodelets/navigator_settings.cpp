#include <cstdlib>

#include "nodelets/navigation_loop.hpp"

namespace pilothouse {
namespace {

/// As ROS itself finds its folder.
std::string defaultRoutesFolder() {
  const char* const ros_home = std::getenv("ROS_HOME");
  if (ros_home != nullptr && *ros_home != '\0') return std::string(ros_home) + "/pilothouse/routes";
  const char* const home = std::getenv("HOME");
  return std::string(home != nullptr ? home : "/tmp") + "/.ros/pilothouse/routes";
}

}  // namespace

NavigatorSettings readNavigatorSettings(const ros::NodeHandle& own) {
  NavigatorSettings settings;
  settings.routes_folder = defaultRoutesFolder();
  std::string unknown = "optimistic", heading = "free";
  StrictParameters reader(own);
  const auto read = [&reader](const char* key, auto& value, const auto& low, const auto& high) {
    reader.read(key, value, low, high);
  };
  reader.read("map_frame", settings.map_frame);
  reader.read("odom_frame", settings.odom_frame);
  reader.read("routes_folder", settings.routes_folder);
  reader.read("unknown", unknown, {"optimistic", "never"});
  reader.read("heading", heading, {"free", "kept"});
  forEachPlanningParameter(settings.planning, read);
  forEachNavigationParameter(settings.navigation, read);
  reader.finish();
  if (unknown == "never") settings.planning.unknown = UnknownFloor::kNever;
  if (heading == "kept") settings.planning.heading = HeadingMode::kKept;
  return settings;
}

}  // namespace pilothouse
