#include "core/floor/binner.hpp"

#include <algorithm>
#include <cmath>

namespace pilothouse {

BinningKernel fastestKernel() {
  return BinningKernel::kReference;
}
bool isSupported(BinningKernel kernel) {
  return kernel == BinningKernel::kReference;
}

void Binner::configure(const GridGeometry& geometry, const HeightScale& scale) {
  geometry_ = geometry;
  scale_ = scale;
  moments_.assign(geometry.cells(), CellMoments{});
}

void Binner::add(float x, float y, float z) {
  const float inverse_cell = 1.0F / geometry_.cell_size;
  const float gx = (x - geometry_.x_min) * inverse_cell;
  const float gy = (y - geometry_.y_min) * inverse_cell;
  // Written so that NaN fails every comparison.
  if (!(gx >= 0.0F && gx < static_cast<float>(geometry_.size_x))) return;
  if (!(gy >= 0.0F && gy < static_cast<float>(geometry_.size_y))) return;
  if (!(z <= scale_.high)) return;
  const float steps = (z - scale_.low) * (1.0F / scale_.step) + 0.5F;
  const auto q = static_cast<std::uint32_t>(
      std::clamp(steps, 0.0F, static_cast<float>(HeightScale::kMaxStep)));
  CellMoments& cell = moments_[geometry_.index(static_cast<int>(gx), static_cast<int>(gy))];
  ++cell.count;
  cell.sum += q;
  cell.sum_square += std::uint64_t{q} * q;
}

const std::vector<CellMoments>& Binner::bin(const CloudView& cloud,
                                            const Eigen::Isometry3f& T_base_camera) {
  std::fill(moments_.begin(), moments_.end(), CellMoments{});
  for (std::uint32_t row = 0; row < cloud.height(); ++row) {
    for (std::uint32_t col = 0; col < cloud.width(); ++col) {
      const Eigen::Vector3f p = T_base_camera * cloud.point(row, col);
      add(p.x(), p.y(), p.z());
    }
  }
  return moments_;
}

const std::vector<CellMoments>& Binner::bin(const DepthView& depth,
                                            const Eigen::Isometry3f& T_base_optical) {
  std::fill(moments_.begin(), moments_.end(), CellMoments{});
  const Intrinsics& k = depth.intrinsics();
  for (std::uint32_t row = 0; row < depth.height(); ++row) {
    for (std::uint32_t col = 0; col < depth.width(); ++col) {
      const float z = depth.metres(row, col);
      if (!(z > 0.0F)) continue;
      const auto x = static_cast<float>((col - k.cx) / k.fx) * z;
      const auto y = static_cast<float>((row - k.cy) / k.fy) * z;
      const Eigen::Vector3f p = T_base_optical * Eigen::Vector3f(x, y, z);
      add(p.x(), p.y(), p.z());
    }
  }
  return moments_;
}

}  // namespace pilothouse
