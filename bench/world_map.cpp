#include "bench/world_map.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace pilothouse::bench {
namespace {

constexpr double kCell = 0.05;    // [m]
constexpr double kLowest = 0.06;  // what is no higher may be driven over [m]
constexpr double kStep = 0.02;    // triangles are looked at so densely [m]
constexpr double kRim = 0.5;      // of the map round what is in it [m]

template <class Visit>
void surfaces(const sim::World& world, const std::function<bool(const sim::Model&)>& includes,
              Visit visit) {
  for (const auto& model : world.models) {
    if (model.path || !includes(model)) continue;
    for (const auto& part : model.parts) {
      if (!part.solid) continue;
      for (const auto& triangle : part.mesh.triangles) {
        std::array<Eigen::Vector3d, 3> corners;
        for (std::size_t i = 0; i < 3; ++i) {
          corners[i] = model.T_world_model * part.mesh.vertices[triangle[i]].cast<double>();
        }
        visit(corners);
      }
    }
  }
}

}  // namespace

MapCells mapOf(const sim::World& world, double robot_height,
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
        if (p.z() < kLowest || p.z() > robot_height || !map.contains(x, y)) continue;
        map.cells[map.index(x, y)] = MapCell::kOccupied;
      }
    }
  });
  return map;
}

}  // namespace pilothouse::bench
