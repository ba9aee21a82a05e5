#include "gui/model/robot_description.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <initializer_list>
#include <sstream>
#include <stdexcept>

namespace pilothouse::gui {

namespace {

constexpr double kPi = 3.14159265358979323846;

struct Fault : std::runtime_error {
  using std::runtime_error::runtime_error;
};

std::string shown(const YAML::Node& node) {
  if (!node || node.IsNull()) return "nothing";
  if (node.IsScalar()) return "'" + node.Scalar() + "'";
  return node.IsSequence() ? "a list" : "a map";
}

[[noreturn]] void fail(const std::string& key, const YAML::Node& node, const std::string& wanted) {
  throw Fault(key + ": " + shown(node) + ", expected " + wanted);
}

std::string text(const YAML::Node& parent, const std::string& key) {
  const YAML::Node node = parent[key];
  if (!node || !node.IsScalar() || node.Scalar().empty()) fail(key, node, "a word");
  return node.Scalar();
}

double number(const YAML::Node& node, const std::string& key, double low, double high) {
  std::ostringstream wanted;
  wanted << "a number from " << low << " to " << high;
  double value = 0.0;
  try {
    value = node.as<double>();
  } catch (const YAML::Exception&) {
    fail(key, node, wanted.str());
  }
  if (!std::isfinite(value) || value < low || value > high) fail(key, node, wanted.str());
  return value;
}

void onlyKnown(const YAML::Node& node, const std::string& where,
               std::initializer_list<const char*> known) {
  for (const auto& entry : node) {
    const auto key = entry.first.as<std::string>();
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    std::string list;
    for (const char* k : known) list += (list.empty() ? "" : ", ") + std::string(k);
    throw Fault(where + key + ": not a known key, expected one of " + list);
  }
}

double doubledArea(const std::vector<FootprintPoint>& points) {
  double area = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& a = points[i];
    const auto& b = points[(i + 1) % points.size()];
    area += a.x * b.y - b.x * a.y;
  }
  return area;
}

std::vector<FootprintPoint> footprint(const YAML::Node& node) {
  if (!node || !node.IsSequence() || node.size() < 3 || node.size() > 64) {
    fail("footprint", node, "3 to 64 points [x, y]");
  }
  std::vector<FootprintPoint> points;
  for (std::size_t i = 0; i < node.size(); ++i) {
    const std::string key = "footprint[" + std::to_string(i) + "]";
    const YAML::Node point = node[i];
    if (!point.IsSequence() || point.size() != 2) fail(key, point, "[x, y] in metres");
    points.push_back(
        {number(point[0], key + " x", -5.0, 5.0), number(point[1], key + " y", -5.0, 5.0)});
  }
  const double area = doubledArea(points);
  if (std::abs(area) < 2e-4) throw Fault("footprint: no area, expected a polygon");
  if (area < 0.0) throw Fault("footprint: clockwise, expected counter-clockwise");
  return points;
}

RobotDescription describe(const YAML::Node& root) {
  if (!root.IsMap())
    throw Fault("expected a map with name, title, base, footprint, height, camera");
  onlyKnown(root, "", {"name", "title", "base", "footprint", "height", "camera", "floor"});
  RobotDescription robot;
  robot.name = text(root, "name");
  robot.title = text(root, "title");
  robot.base = text(root, "base");
  if (robot.base != "four_wheel_steered" && robot.base != "differential" &&
      robot.base != "omnidirectional") {
    fail("base", root["base"], "four_wheel_steered, differential or omnidirectional");
  }
  robot.footprint = footprint(root["footprint"]);
  robot.height = number(root["height"], "height", 0.01, 5.0);
  const YAML::Node camera = root["camera"];
  if (!camera || !camera.IsMap()) fail("camera", camera, "a map with frame, x, y, z and angles");
  onlyKnown(camera, "camera.", {"frame", "x", "y", "z", "roll_deg", "pitch_deg", "yaw_deg"});
  robot.camera_frame = text(camera, "frame");
  robot.camera_x = number(camera["x"], "camera.x", -5.0, 5.0);
  robot.camera_y = number(camera["y"], "camera.y", -5.0, 5.0);
  robot.camera_z = number(camera["z"], "camera.z", 0.0, 5.0);
  robot.camera_yaw = number(camera["yaw_deg"], "camera.yaw_deg", -180.0, 180.0) * kPi / 180.0;
  return robot;
}

}  // namespace

Checked<RobotDescription> parseRobot(const std::string& yaml) {
  try {
    return Checked<RobotDescription>::of(describe(YAML::Load(yaml)));
  } catch (const Fault& fault) {
    return Checked<RobotDescription>::refused(fault.what());
  } catch (const YAML::Exception& error) {
    return Checked<RobotDescription>::refused("not YAML: " + std::string(error.what()));
  }
}

Checked<RobotDescription> readRobot(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream content;
  if (file) content << file.rdbuf();
  if (!file) return Checked<RobotDescription>::refused(path + ": cannot be read");
  auto robot = parseRobot(content.str());
  return robot ? robot : Checked<RobotDescription>::refused(path + ": " + robot.reason());
}

}  // namespace pilothouse::gui
