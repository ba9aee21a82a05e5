#pragma once

#include <string>

#include "sim/sim_robot.hpp"
#include "sim/world.hpp"

namespace pilothouse::sim {

/// Box with its underside's middle at the origin.
inline Mesh boxMesh(const Eigen::Vector3f& size) {
  Mesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.emplace_back((i & 1 ? 0.5F : -0.5F) * size.x(), (i & 2 ? 0.5F : -0.5F) * size.y(),
                               i & 4 ? size.z() : 0.0F);
  }
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

inline Eigen::Isometry3d at(double x, double y, double z = 0.0, double heading = 0.0) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() = Eigen::Vector3d(x, y, z);
  T.linear() = Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return T;
}

inline void add(World& world, const std::string& name, const Mesh& mesh,
                const Eigen::Isometry3d& T_world_model) {
  Model model;
  model.name = name;
  model.T_world_model = T_world_model;
  Part part;
  part.name = name;
  part.mesh = mesh;
  model.parts.push_back(part);
  world.models.push_back(model);
}

/// Floor of 40 x 40 m at z = 0 whose front edge is at x = `end`.
inline World flatWorld(double end = 20.0) {
  World world;
  world.name = "flat";
  add(world, "floor", boxMesh({40.0F, 40.0F, 1.0F}), at(end - 20.0, 0.0, -1.0));
  return world;
}

/// Rises from (x, 0) along x at `slope` over `length` [m], 4 m wide.
inline void addRamp(World& world, double x, double slope, double length) {
  Mesh mesh;
  const auto l = static_cast<float>(length), h = static_cast<float>(slope * length);
  mesh.vertices = {{0, -2, 0}, {0, 2, 0}, {l, -2, 0}, {l, 2, 0}, {l, -2, h}, {l, 2, h}};
  mesh.triangles = {{0, 4, 5}, {0, 5, 1}, {0, 2, 4}, {1, 5, 3}, {2, 3, 5}, {2, 5, 4}};
  add(world, "ramp", mesh, at(x, 0.0));
}

inline SimRobot testRobot(BaseKind kind = BaseKind::kFourWheelSteered) {
  SimRobot robot{"test", Footprint({{0.25, 0.2}, {-0.25, 0.2}, {-0.25, -0.2}, {0.25, -0.2}})};
  robot.height = 0.75;
  robot.base.kind = kind;
  robot.base.track = 0.34;
  robot.base.wheelbase = kind == BaseKind::kDifferential ? 0.0 : 0.40;
  robot.base.wheel_radius = 0.075;
  // Optical axes 0.65 m up, looking down 26 degrees.
  Eigen::Matrix3d R_body_optical;
  R_body_optical << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  robot.T_base_camera.translation() = Eigen::Vector3d(0.15, 0.0, 0.65);
  robot.T_base_camera.linear() =
      Eigen::AngleAxisd(26.0 * 3.14159265358979 / 180.0, Eigen::Vector3d::UnitY()) * R_body_optical;
  SimRanger front{"front", at(0.25, 0.0, 0.2)};
  SimRanger rear{"rear", at(-0.25, 0.0, 0.2, 3.14159265358979)};
  robot.rangers = {front, rear};
  return robot;
}

}  // namespace pilothouse::sim
