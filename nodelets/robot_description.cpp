#include "nodelets/robot_description.hpp"

#include <cmath>

#include "nodelets/floor_settings.hpp"

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
  reader.finish();
  return robot;
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
