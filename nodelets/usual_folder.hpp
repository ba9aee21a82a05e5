#pragma once

#include <cstdlib>
#include <string>

namespace pilothouse {

/// Where maps are kept unless told: in ROS's home.
inline std::string usualMapFolder() {
  if (const char* ros_home = std::getenv("ROS_HOME")) return std::string(ros_home) + "/maps";
  const char* home = std::getenv("HOME");
  return std::string(home != nullptr ? home : "/tmp") + "/.ros/maps";
}

}  // namespace pilothouse
