#include "sim/shapes.hpp"

#include <cmath>

namespace pilothouse::sim {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3d;
using Eigen::Vector3f;

std::uint32_t addVertex(Mesh& mesh, const Vector3d& point, double s, double t) {
  mesh.vertices.push_back(point.cast<float>());
  mesh.texture_coordinates.emplace_back(static_cast<float>(s), static_cast<float>(t));
  return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
}

/// Rectangle centre +- right / 2 +- up / 2, seen from where right is right and up is up.
void addRectangle(Mesh& mesh, const Vector3d& centre, const Vector3d& right, const Vector3d& up) {
  const double w = right.norm(), h = up.norm();
  const auto a = addVertex(mesh, centre - 0.5 * right - 0.5 * up, 0.0, 0.0);
  addVertex(mesh, centre + 0.5 * right - 0.5 * up, w, 0.0);
  const auto c = addVertex(mesh, centre + 0.5 * right + 0.5 * up, w, h);
  addVertex(mesh, centre - 0.5 * right + 0.5 * up, 0.0, h);
  mesh.triangles.push_back({a, a + 1, c});
  mesh.triangles.push_back({a, c, c + 1});
}

Vector3d onCircle(double radius, double angle, double z) {
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

/// Joins two rings of corners + 1 vertices each, the lower of which begins at `low`.
void joinRings(Mesh& mesh, std::uint32_t low, std::uint32_t high, int corners) {
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(corners); ++i) {
    mesh.triangles.push_back({low + i, low + i + 1, high + i + 1});
    mesh.triangles.push_back({low + i, high + i + 1, high + i});
  }
}

Eigen::Isometry3d at(double x, double y, double z) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

}  // namespace

Mesh boxMesh(const Vector3d& size) {
  const Vector3d x = size.x() * Vector3d::UnitX(), y = size.y() * Vector3d::UnitY(),
                 z = size.z() * Vector3d::UnitZ();
  Mesh mesh;
  addRectangle(mesh, 0.5 * x, y, z);
  addRectangle(mesh, -0.5 * x, -y, z);
  addRectangle(mesh, 0.5 * y, -x, z);
  addRectangle(mesh, -0.5 * y, x, z);
  addRectangle(mesh, 0.5 * z, x, y);
  addRectangle(mesh, -0.5 * z, x, -y);
  return mesh;
}

Mesh cylinderMesh(double radius, double length, int corners) {
  Mesh mesh;
  std::uint32_t rings[2];
  for (int end = 0; end < 2; ++end) {
    rings[end] = static_cast<std::uint32_t>(mesh.vertices.size());
    for (int i = 0; i <= corners; ++i) {
      const double angle = 2.0 * M_PI * i / corners;
      const double z = (end - 0.5) * length;
      addVertex(mesh, onCircle(radius, angle, z), radius * angle, z);
    }
  }
  joinRings(mesh, rings[0], rings[1], corners);
  for (int end = 0; end < 2; ++end) {
    const double z = (end - 0.5) * length;
    const auto middle = addVertex(mesh, {0.0, 0.0, z}, 0.0, 0.0);
    for (int i = 0; i <= corners; ++i) {
      const Vector3d rim = onCircle(radius, 2.0 * M_PI * i / corners, z);
      const auto last = addVertex(mesh, rim, rim.x(), rim.y());
      if (i == 0) continue;
      if (end == 1) mesh.triangles.push_back({middle, last - 1, last});
      if (end == 0) mesh.triangles.push_back({middle, last, last - 1});
    }
  }
  return mesh;
}

Mesh sphereMesh(double radius, int corners) {
  Mesh mesh;
  const int rings = corners / 2;
  for (int ring = 0; ring <= rings; ++ring) {
    const double latitude = M_PI * (static_cast<double>(ring) / rings - 0.5);
    const auto begin = static_cast<std::uint32_t>(mesh.vertices.size());
    for (int i = 0; i <= corners; ++i) {
      const double angle = 2.0 * M_PI * i / corners;
      addVertex(mesh, onCircle(radius * std::cos(latitude), angle, radius * std::sin(latitude)),
                radius * angle, radius * latitude);
    }
    const auto ring_size = static_cast<std::uint32_t>(corners + 1);
    if (ring > 0) joinRings(mesh, begin - ring_size, begin, corners);
  }
  return mesh;
}

Mesh planeMesh(const Vector3d& normal, const Eigen::Vector2d& size) {
  const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), normal);
  Mesh mesh;
  addRectangle(mesh, Vector3d::Zero(), turn * (size.x() * Vector3d::UnitX()),
               turn * (size.y() * Vector3d::UnitY()));
  return mesh;
}

Mesh moved(Mesh mesh, const Eigen::Isometry3d& T_model_mesh) {
  for (Vector3f& vertex : mesh.vertices)
    vertex = (T_model_mesh * vertex.cast<double>()).cast<float>();
  return mesh;
}

void scaleTexture(Mesh& mesh, double metres) {
  for (Vector2f& coordinate : mesh.texture_coordinates) coordinate /= static_cast<float>(metres);
}

std::vector<Part> personParts(const Vector3f& shirt, const Vector3f& trousers) {
  const Vector3f skin(0.87F, 0.68F, 0.55F), hair(0.25F, 0.17F, 0.11F), shoe(0.12F, 0.12F, 0.13F);
  std::vector<Part> parts;
  const auto add = [&](const char* name, const Mesh& mesh, const Eigen::Isometry3d& pose,
                       const Vector3f& colour) {
    Part part;
    part.name = name;
    part.mesh = moved(mesh, pose);
    part.material.colour = colour;
    parts.push_back(std::move(part));
  };
  for (const double side : {1.0, -1.0}) {
    add("shoe", boxMesh({0.28, 0.10, 0.08}), at(0.05 + 0.04 * side, 0.10 * side, 0.04), shoe);
    add("leg", cylinderMesh(0.075, 0.78, 12), at(0.02 * side, 0.10 * side, 0.47), trousers);
    const auto arm = at(-0.03 * side, 0.235 * side, 1.12) *
                     Eigen::AngleAxisd(-0.12 * side, Vector3d::UnitX()) *
                     Eigen::AngleAxisd(-0.2 * side, Vector3d::UnitY());
    add("arm", cylinderMesh(0.045, 0.58, 10), Eigen::Isometry3d(arm), shirt * 0.9F);
  }
  Eigen::Isometry3d flat = at(0.0, 0.0, 1.12);
  Mesh body = cylinderMesh(0.19, 0.62, 16);
  for (Vector3f& vertex : body.vertices) vertex.x() *= 0.62F;
  add("body", body, flat, shirt);
  add("neck", cylinderMesh(0.055, 0.12, 10), at(0.0, 0.0, 1.47), skin);
  add("head", sphereMesh(0.115, 16), at(0.01, 0.0, 1.61), skin);
  add("hair", sphereMesh(0.118, 16), at(-0.018, 0.0, 1.635), hair);
  return parts;
}

}  // namespace pilothouse::sim
