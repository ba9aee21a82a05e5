#include "doors/package_files.hpp"

#include <ros/package.h>

#include <fstream>
#include <stdexcept>

namespace pilothouse {

std::string packageFile(const std::string& relative) {
  const std::string package = ros::package::getPath("pilothouse");
  if (package.empty()) {
    throw std::runtime_error(relative + ": the package pilothouse is not in ROS_PACKAGE_PATH");
  }
  const std::string path = package + '/' + relative;
  if (!std::ifstream(path)) throw std::runtime_error(path + ": cannot be read");
  return path;
}

}  // namespace pilothouse
