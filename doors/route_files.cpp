#include "doors/route_files.hpp"

#include <algorithm>
#include <boost/filesystem.hpp>
#include <cmath>
#include <limits>
#include <sstream>

#include "core/tasks/route_faults.hpp"
#include "doors/atomic_file.hpp"
#include "doors/file_bytes.hpp"
#include "doors/goal_views.hpp"
#include "doors/strict_parameters.hpp"
#include "doors/yaml_values.hpp"

namespace pilothouse {
namespace {

constexpr std::size_t kLongestName = 64;
const std::string kEnding = ".yaml";

std::string pathOf(const std::string& folder, const std::string& name) {
  return folder + "/" + name + kEnding;
}

bool isPlain(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '/';
  });
}

/// @throws ParameterFault naming each fault.
GoalRoute readRoute(const std::string& path, const XmlRpc::XmlRpcValue& values) {
  StrictParameters reader(path, values);
  GoalRoute route;
  bool loop = false;
  std::string frame = "map";
  reader.quiet();
  reader.require({"points"});
  reader.read("frame", frame);
  reader.read("loop", loop);
  XmlRpc::XmlRpcValue points = reader.raw("points");
  const bool list = points.getType() == XmlRpc::XmlRpcValue::TypeArray;
  if (points.valid() && !list) reader.addWrong("points", points, "a list");
  const int size = list ? points.size() : 0;
  // Many points are not looked at one by one only to be refused.
  for (int i = 0; i < std::min(size, static_cast<int>(kMostStops) + 1); ++i) {
    StrictParameters one(path + "/points[" + std::to_string(i) + "]", points[i]);
    RoutePoint point;
    double pause = 0.0;
    point.heading = std::numeric_limits<double>::quiet_NaN();
    one.require({"x", "y"});
    one.read("x", point.x);
    one.read("y", point.y);
    one.read("heading", point.heading);
    one.read("pause", pause);
    point.pause = static_cast<float>(pause);
    route.points.push_back(point);
    reader.merge(one);
  }
  reader.finish();
  route.header.frame_id = frame;
  route.loop = loop ? 1 : 0;
  return route;
}

}  // namespace

std::string routeNameFault(const std::string& name) {
  if (!name.empty() && name.size() <= kLongestName && isPlain(name) &&
      name.find('/') == std::string::npos) {
    return {};
  }
  return "name is \"" + name.substr(0, kLongestName) +
         "\", expected 1 to 64 letters, digits, _ and -";
}

void saveRoute(const std::string& folder, const std::string& name, const GoalRoute& route) {
  const std::string fault = routeNameFault(name);
  if (!fault.empty()) throw std::runtime_error(fault);
  if (!isPlain(route.header.frame_id)) throw std::runtime_error("the frame's name is not plain");
  const auto wish = openGoalRoute(route);
  if (!wish) throw std::runtime_error(wish.reason());
  std::ostringstream text;
  text.precision(9);
  text << "frame: " << (route.header.frame_id.empty() ? "map" : route.header.frame_id)
       << "\nloop: " << (route.loop != 0 ? "true" : "false") << "\npoints:\n";
  for (const auto& point : route.points) {
    text << "  - {x: " << point.x << ", y: " << point.y;
    if (!std::isnan(point.heading)) text << ", heading: " << point.heading;
    if (point.pause > 0.0F) text << ", pause: " << point.pause;
    text << "}\n";
  }
  boost::system::error_code error;
  boost::filesystem::create_directories(folder, error);
  writeAtomically(pathOf(folder, name), text.str());
}

Checked<GoalRoute> loadRoute(const std::string& folder, const std::string& name) {
  using Result = Checked<GoalRoute>;
  const std::string fault = routeNameFault(name);
  if (!fault.empty()) return Result::refused(fault);
  const std::string path = pathOf(folder, name);
  const auto values = readYaml(path);
  if (!values) return Result::refused(values.reason());
  try {
    if (values->getType() != XmlRpc::XmlRpcValue::TypeStruct) {
      return Result::refused(path + ": expected keys with values");
    }
    GoalRoute route = readRoute(path, *values);
    route.name = name;
    const auto wish = openGoalRoute(route);
    return wish ? Result::of(std::move(route)) : Result::refused(path + ": " + wish.reason());
  } catch (const ParameterFault& faults) {
    return Result::refused(faults.what());
  }
}

std::vector<std::string> routesIn(const std::string& folder) {
  std::vector<std::string> names;
  boost::system::error_code error;
  if (!boost::filesystem::is_directory(folder, error)) return names;
  for (const auto& file : listFolder(folder)) {
    if (!endsWith(file, kEnding)) continue;
    names.push_back(file.substr(0, file.size() - kEnding.size()));
  }
  return names;
}

}  // namespace pilothouse
