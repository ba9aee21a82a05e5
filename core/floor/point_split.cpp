#include "core/floor/point_split.hpp"

#include <cmath>
#include <cstdint>

#include "core/floor/floor_surface.hpp"

namespace pilothouse {
namespace {

class Splitter {
 public:
  Splitter(const FloorCells& grid, const FloorParameters& parameters)
      : grid_(grid), parameters_(parameters), step_(static_cast<float>(parameters.step_height)) {
    std::vector<std::uint8_t> is_floor(grid.classes.size(), 0);
    for (std::size_t i = 0; i < is_floor.size(); ++i) {
      is_floor[i] = isDrivable(grid.classes[i]) ? 1 : 0;
    }
    surface_.configure(grid.geometry);
    surface_.fit(is_floor, grid.heights);
    ground_.resize(grid.classes.size());
    for (int iy = 0; iy < grid.geometry.size_y; ++iy) {
      for (int ix = 0; ix < grid.geometry.size_x; ++ix) {
        const std::size_t i = grid.geometry.index(ix, iy);
        ground_[i] = is_floor[i] != 0 ? grid.heights[i] : surface_.expected(ix, iy);
      }
    }
  }

  CellClass classOf(const Eigen::Vector3f& p) const {
    const GridGeometry& g = grid_.geometry;
    const float gx = (p.x() - g.x_min) / g.cell_size;
    const float gy = (p.y() - g.y_min) / g.cell_size;
    if (!(gx >= 0.0F && gx < static_cast<float>(g.size_x) && gy >= 0.0F &&
          gy < static_cast<float>(g.size_y))) {
      return CellClass::kUnknown;
    }
    if (!(p.z() <= static_cast<float>(parameters_.clear_height))) return CellClass::kUnknown;
    const std::size_t i = g.index(static_cast<int>(gx), static_cast<int>(gy));
    const CellClass cell = grid_.classes[i];
    if (parameters_.method == FloorMethod::kOriginal) return cell;
    const float above = p.z() - ground_[i];
    if (isDrivable(cell)) return above > step_ ? CellClass::kObstacle : cell;
    if (cell != CellClass::kObstacle) return cell;
    return std::abs(above) <= 0.5F * step_ ? CellClass::kFloor : CellClass::kObstacle;
  }

 private:
  const FloorCells& grid_;
  const FloorParameters& parameters_;
  float step_;
  FloorSurface surface_;
  std::vector<float> ground_;
};

}  // namespace

void splitPoints(const CloudView& cloud, const Eigen::Isometry3f& T_base_camera,
                 const FloorCells& grid, const FloorParameters& parameters,
                 std::vector<CellClass>& out) {
  const Splitter splitter(grid, parameters);
  out.resize(cloud.points());
  std::size_t next = 0;
  for (std::uint32_t row = 0; row < cloud.height(); ++row) {
    for (std::uint32_t col = 0; col < cloud.width(); ++col) {
      out[next++] = splitter.classOf(T_base_camera * cloud.point(row, col));
    }
  }
}

void splitPoints(const DepthView& depth, const Eigen::Isometry3f& T_base_optical,
                 const FloorCells& grid, const FloorParameters& parameters,
                 std::vector<CellClass>& out) {
  const Splitter splitter(grid, parameters);
  const Intrinsics& k = depth.intrinsics();
  out.resize(std::size_t{depth.width()} * depth.height());
  std::size_t next = 0;
  for (std::uint32_t row = 0; row < depth.height(); ++row) {
    const auto ray_y = static_cast<float>((row - k.cy) / k.fy);
    for (std::uint32_t col = 0; col < depth.width(); ++col) {
      const float z = depth.metres(row, col);
      const auto ray_x = static_cast<float>((col - k.cx) / k.fx);
      out[next++] =
          z > 0.0F ? splitter.classOf(T_base_optical * Eigen::Vector3f(ray_x * z, ray_y * z, z))
                   : CellClass::kUnknown;
    }
  }
}

}  // namespace pilothouse
