#include "doors/robot_description.hpp"

#include <algorithm>
#include <cmath>

#include "core/motion/parameter_ranges.hpp"
#include "doors/floor_settings.hpp"
#include "doors/yaml_values.hpp"

namespace pilothouse {
namespace {

using XmlRpc::XmlRpcValue;

constexpr double kFarthestCorner = 5.0;  // [m]

/// A finite number in an XmlRpcValue, or NaN.
double numberIn(XmlRpcValue value) {
  if (value.getType() == XmlRpcValue::TypeDouble) return static_cast<double&>(value);
  if (value.getType() == XmlRpcValue::TypeInt) return static_cast<int&>(value);
  return std::nan("");
}

double doubledArea(const std::vector<std::array<double, 2>>& corners) {
  double sum = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto& a = corners[i];
    const auto& b = corners[(i + 1) % corners.size()];
    sum += a[0] * b[1] - a[1] * b[0];
  }
  return sum;
}

void readFootprint(StrictParameters& reader, std::vector<std::array<double, 2>>& footprint) {
  const XmlRpcValue list = reader.raw("footprint");
  if (!list.valid()) return;
  const std::string expected =
      "at least 3 corners [x, y] within 5 m of the origin, counter-clockwise";
  if (list.getType() != XmlRpcValue::TypeArray || list.size() < 3 || list.size() > 256) {
    return reader.addWrong("footprint", list, expected);
  }
  for (int i = 0; i < list.size(); ++i) {
    const XmlRpcValue& corner = list[i];
    const bool pair = corner.getType() == XmlRpcValue::TypeArray && corner.size() == 2;
    const double x = pair ? numberIn(corner[0]) : std::nan("");
    const double y = pair ? numberIn(corner[1]) : std::nan("");
    if (!(std::hypot(x, y) <= kFarthestCorner)) {
      return reader.addWrong("footprint[" + std::to_string(i) + "]", corner, expected);
    }
    footprint.push_back({x, y});
  }
  if (!(doubledArea(footprint) > 0.0)) reader.addWrong("footprint", list, expected);
}

void readCamera(StrictParameters reader, StrictParameters& parent, CameraOnRobot& camera) {
  reader.require({"frame", "x", "y", "z", "roll_deg", "pitch_deg", "yaw_deg"});
  reader.read("frame", camera.frame);
  reader.read("x", camera.x, -10.0, 10.0);
  reader.read("y", camera.y, -10.0, 10.0);
  reader.read("z", camera.z, -10.0, 10.0);
  reader.read("roll_deg", camera.roll_deg, -180.0, 180.0);
  reader.read("pitch_deg", camera.pitch_deg, -90.0, 90.0);
  reader.read("yaw_deg", camera.yaw_deg, -180.0, 180.0);
  parent.merge(reader);
}

/// For forEach...Parameter.
struct ReadEach {
  StrictParameters& reader;
  template <class T>
  void operator()(const char* key, T& value, T low, T high) {
    reader.read(key, value, low, high);
  }
};

BaseKind kindOf(const std::string& base) {
  if (base == "differential") return BaseKind::kDifferential;
  return base == "omnidirectional" ? BaseKind::kOmnidirectional : BaseKind::kFourWheelSteered;
}

void readDrive(StrictParameters reader, StrictParameters& parent, BaseParameters& drive) {
  const std::size_t before = parent.faultCount();
  forEachBaseParameter(drive, ReadEach{reader});
  parent.merge(reader);
  if (parent.faultCount() > before) return;
  for (const auto& fault : validate(drive)) parent.addFault("drive: " + fault);
}

void readAvoidance(StrictParameters reader, StrictParameters& parent, AvoidanceParameters& values) {
  const std::size_t before = parent.faultCount();
  forEachAvoidanceParameter(values, ReadEach{reader});
  parent.merge(reader);
  if (parent.faultCount() > before) return;
  for (const auto& fault : validate(values)) parent.addFault("avoidance: " + fault);
}

bool isName(const std::string& text) {
  return !text.empty() && text.size() <= 64 &&
         std::all_of(text.begin(), text.end(),
                     [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
}

RangerOnRobot readRanger(StrictParameters reader, StrictParameters& parent) {
  RangerOnRobot ranger;
  reader.require({"name", "x", "y", "z", "yaw_deg"});
  reader.read("name", ranger.name);
  if (reader.has("name") && !isName(ranger.name)) {
    reader.addFault("name is \"" + ranger.name + "\", expected letters, digits and _");
  }
  reader.read("x", ranger.x, -10.0, 10.0);
  reader.read("y", ranger.y, -10.0, 10.0);
  reader.read("z", ranger.z, -10.0, 10.0);
  reader.read("yaw_deg", ranger.yaw_deg, -180.0, 180.0);
  reader.read("field_of_view_deg", ranger.field_of_view_deg, 1.0, 90.0);
  reader.read("max_range", ranger.max_range, 0.1, 20.0);
  reader.read("min_range", ranger.min_range, 0.0, ranger.max_range);
  parent.merge(reader);
  return ranger;
}

void readRangers(StrictParameters& reader, std::vector<RangerOnRobot>& rangers) {
  XmlRpcValue list = reader.raw("rangers");
  if (!list.valid()) return;
  if (list.getType() != XmlRpcValue::TypeArray || list.size() > 16) {
    return reader.addWrong("rangers", list, "a list of at most 16 rangers");
  }
  for (int i = 0; i < list.size(); ++i) {
    RangerOnRobot ranger = readRanger(reader.element("rangers", i), reader);
    for (const auto& other : rangers) {
      if (other.name == ranger.name) {
        reader.addFault("rangers[" + std::to_string(i) + "]: name is \"" + ranger.name +
                        "\" again, expected another");
      }
    }
    rangers.push_back(std::move(ranger));
  }
}

bool endsWith(const std::string& text, const std::string& ending) {
  return text.size() > ending.size() &&
         text.compare(text.size() - ending.size(), ending.size(), ending) == 0;
}

}  // namespace

RobotDescription readRobot(StrictParameters& reader) {
  RobotDescription robot;
  reader.require({"name", "title", "base", "footprint", "height", "camera"});
  reader.read("name", robot.name);
  reader.read("title", robot.title);
  reader.read("base", robot.base, {"four_wheel_steered", "differential", "omnidirectional"});
  readFootprint(reader, robot.footprint);
  reader.read("height", robot.height, 0.01, 10.0);
  if (reader.has("camera")) readCamera(reader.child("camera"), reader, robot.camera);
  StrictParameters floor = reader.child("floor");
  readFloorParameters(floor, robot.floor);
  reader.merge(floor);
  robot.drive.kind = kindOf(robot.base);
  if (robot.drive.kind != BaseKind::kDifferential) robot.drive.wheelbase = 0.36;
  readDrive(reader.child("drive"), reader, robot.drive);
  readRangers(reader, robot.rangers);
  readAvoidance(reader.child("avoidance"), reader, robot.avoidance);
  reader.finish();
  return robot;
}

Checked<RobotDescription> readRobotFile(const std::string& path) {
  const auto values = readYaml(path);
  if (!values) return Checked<RobotDescription>::refused(values.reason());
  try {
    StrictParameters reader(path, *values);
    reader.quiet();
    return Checked<RobotDescription>::of(readRobot(reader));
  } catch (const ParameterFault& fault) {
    return Checked<RobotDescription>::refused(fault.what());
  }
}

Footprint RobotDescription::outline() const {
  std::vector<Eigen::Vector2d> corners;
  for (const auto& corner : footprint) corners.emplace_back(corner[0], corner[1]);
  return Footprint(corners);
}

Eigen::Isometry3d bodyPose(const CameraOnRobot& camera) {
  constexpr double kRadians = 3.14159265358979323846 / 180.0;
  Eigen::Isometry3d T_base_link = Eigen::Isometry3d::Identity();
  T_base_link.translate(Eigen::Vector3d(camera.x, camera.y, camera.z));
  T_base_link.rotate(Eigen::AngleAxisd(camera.yaw_deg * kRadians, Eigen::Vector3d::UnitZ()));
  T_base_link.rotate(Eigen::AngleAxisd(camera.pitch_deg * kRadians, Eigen::Vector3d::UnitY()));
  T_base_link.rotate(Eigen::AngleAxisd(camera.roll_deg * kRadians, Eigen::Vector3d::UnitX()));
  return T_base_link;
}

Eigen::Isometry3d rangerPose(const RangerOnRobot& ranger) {
  CameraOnRobot body;
  body.x = ranger.x;
  body.y = ranger.y;
  body.z = ranger.z;
  body.yaw_deg = ranger.yaw_deg;
  return bodyPose(body);
}

std::vector<ObjectMerger::Ranger> rangersOf(const RobotDescription& robot) {
  std::vector<ObjectMerger::Ranger> rangers;
  for (const auto& ranger : robot.rangers) rangers.push_back({ranger.name, rangerPose(ranger)});
  return rangers;
}

Eigen::Isometry3d opticalRotation() {
  Eigen::Isometry3d T_link_optical = Eigen::Isometry3d::Identity();
  T_link_optical.linear() << 0, 0, 1,  //
      -1, 0, 0,                        //
      0, -1, 0;
  return T_link_optical;
}

std::string bodyFrame(const std::string& optical_frame) {
  for (const std::string ending : {"_depth_optical_frame", "_optical_frame"}) {
    if (endsWith(optical_frame, ending)) {
      return optical_frame.substr(0, optical_frame.size() - ending.size()) + "_link";
    }
  }
  return optical_frame + "_link";
}

}  // namespace pilothouse
