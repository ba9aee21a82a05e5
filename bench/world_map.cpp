#include "bench/world_map.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace pilothouse::bench {
namespace {

constexpr double kCell = 0.05;    // [m]
constexpr double kLowest = 0.06;  // what is no higher may be driven over [m]
constexpr double kStep = 0.02;    // triangles are looked at so densely [m]
constexpr double kRim = 0.5;      // of the map round what is in it [m]

std::array<Eigen::Vector3d, 3> cornersOf(const sim::Model& model, const sim::Part& part,
                                         const std::array<std::uint32_t, 3>& triangle) {
  std::array<Eigen::Vector3d, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) {
    corners[i] = model.T_world_model * part.mesh.vertices[triangle[i]].cast<double>();
  }
  return corners;
}

template <class Visit>
void surfaces(const sim::World& world, const std::function<bool(const sim::Model&)>& includes,
              Visit visit) {
  for (const auto& model : world.models) {
    if (model.path || !includes(model)) continue;
    for (const auto& part : model.parts) {
      if (!part.solid) continue;
      for (const auto& triangle : part.mesh.triangles) visit(cornersOf(model, part, triangle));
    }
  }
}

/// The part of a triangle between two heights, as points of its outline.
void clip(const std::array<Eigen::Vector3d, 3>& corners, double low, double high,
          std::vector<Eigen::Vector2d>& points) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d &a = corners[i], &b = corners[(i + 1) % 3];
    if (a.z() >= low && a.z() <= high) points.emplace_back(a.head<2>());
    for (const double height : {low, high}) {
      if ((a.z() < height) == (b.z() < height)) continue;
      points.emplace_back((a + (height - a.z()) / (b.z() - a.z()) * (b - a)).head<2>());
    }
  }
}

bool isConvex(const sim::Mesh& mesh) {
  for (const auto& triangle : mesh.triangles) {
    const Eigen::Vector3f& at = mesh.vertices[triangle[0]];
    const Eigen::Vector3f normal =
        (mesh.vertices[triangle[1]] - at).cross(mesh.vertices[triangle[2]] - at).normalized();
    for (const auto& vertex : mesh.vertices) {
      if (normal.dot(vertex - at) > 1e-4F) return false;
    }
  }
  return true;
}

}  // namespace

MapCells mapOf(const sim::World& world, double clear_height,
               const std::function<bool(const sim::Model&)>& includes) {
  Eigen::AlignedBox2d bounds;
  surfaces(world, includes, [&bounds](const auto& corners) {
    for (const auto& corner : corners) bounds.extend(corner.template head<2>());
  });
  MapCells map;
  map.cell_size = kCell;
  map.origin_x = bounds.min().x() - kRim;
  map.origin_y = bounds.min().y() - kRim;
  map.size_x = static_cast<int>(std::ceil((bounds.sizes().x() + 2.0 * kRim) / kCell));
  map.size_y = static_cast<int>(std::ceil((bounds.sizes().y() + 2.0 * kRim) / kCell));
  map.cells.assign(static_cast<std::size_t>(map.size_x) * static_cast<std::size_t>(map.size_y),
                   MapCell::kFree);
  surfaces(world, includes, [&](const std::array<Eigen::Vector3d, 3>& corners) {
    const Eigen::Vector3d a = corners[1] - corners[0], b = corners[2] - corners[0];
    const double longest = std::max({a.norm(), b.norm(), (a - b).norm()});
    const int steps = std::max(1, static_cast<int>(std::ceil(longest / kStep)));
    for (int i = 0; i <= steps; ++i) {
      for (int j = 0; i + j <= steps; ++j) {
        const Eigen::Vector3d p = corners[0] + a * i / steps + b * j / steps;
        const int x = map.column(p.x()), y = map.row(p.y());
        if (p.z() < kLowest || p.z() > clear_height || !map.contains(x, y)) continue;
        map.cells[map.index(x, y)] = MapCell::kOccupied;
      }
    }
  });
  return map;
}

std::vector<ConvexShape> shapesOf(const sim::World& world, double clear_height,
                                  const std::function<bool(const sim::Model&)>& includes) {
  std::vector<ConvexShape> shapes;
  for (const auto& model : world.models) {
    if (model.path || !includes(model)) continue;
    for (const auto& part : model.parts) {
      if (!part.solid) continue;
      const bool whole = isConvex(part.mesh);
      std::vector<Eigen::Vector2d> points;
      for (const auto& triangle : part.mesh.triangles) {
        clip(cornersOf(model, part, triangle), kLowest, clear_height, points);
        if (whole || points.empty()) continue;
        shapes.emplace_back(std::exchange(points, {}));
      }
      if (!points.empty()) shapes.emplace_back(points);
    }
  }
  return shapes;
}

}  // namespace pilothouse::bench
