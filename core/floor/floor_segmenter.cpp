#include "core/floor/floor_segmenter.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/floor/binner.hpp"

namespace pilothouse {

struct FloorSegmenter::Impl {
  FloorParameters parameters;
  Binner binner;
  FloorGrid grid;
  HeightScale scale;

  void judge(const std::vector<CellMoments>& moments);
};

FloorSegmenter::FloorSegmenter(const FloorParameters& parameters) : impl_(std::make_unique<Impl>()) {
  setParameters(parameters);
}
FloorSegmenter::~FloorSegmenter() = default;

const FloorParameters& FloorSegmenter::parameters() const { return impl_->parameters; }

void FloorSegmenter::setParameters(const FloorParameters& p) {
  const auto faults = validate(p);
  if (!faults.empty()) {
    std::string text = "floor parameters:";
    for (const auto& fault : faults) text += ' ' + fault + ';';
    throw std::invalid_argument(text);
  }
  impl_->parameters = p;
  GridGeometry& g = impl_->grid.geometry;
  g.cell_size = static_cast<float>(p.cell_size);
  g.x_min = static_cast<float>(p.x_min);
  g.y_min = static_cast<float>(-p.half_width);
  g.size_x = static_cast<int>(std::lround((p.range - p.x_min) / p.cell_size));
  g.size_y = static_cast<int>(std::lround(2.0 * p.half_width / p.cell_size));
  impl_->scale.low = static_cast<float>(-p.depth_below);
  impl_->scale.high = static_cast<float>(p.clear_height);
  impl_->binner.configure(g, impl_->scale);
  impl_->grid.classes.assign(g.cells(), CellClass::kUnknown);
  impl_->grid.heights.assign(g.cells(), 0.0F);
  impl_->grid.deviations.assign(g.cells(), 0.0F);
  impl_->grid.counts.assign(g.cells(), 0);
}

void FloorSegmenter::Impl::judge(const std::vector<CellMoments>& moments) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t i = 0; i < moments.size(); ++i) {
    const CellMoments& m = moments[i];
    grid.counts[i] = m.count;
    if (m.count < static_cast<std::uint32_t>(parameters.min_points)) {
      grid.classes[i] = CellClass::kUnknown;
      grid.heights[i] = grid.deviations[i] = nan;
      continue;
    }
    const double n = m.count;
    const double mean = static_cast<double>(m.sum) / n;
    const double variance = static_cast<double>(m.sum_square) / n - mean * mean;
    grid.heights[i] = static_cast<float>(scale.low + scale.step * mean);
    grid.deviations[i] = static_cast<float>(scale.step * std::sqrt(std::max(0.0, variance)));
    grid.classes[i] = grid.deviations[i] > parameters.obstacle_deviation ? CellClass::kObstacle
                                                                        : CellClass::kFloor;
  }
}

const FloorGrid& FloorSegmenter::segment(const CloudView& cloud,
                                         const Eigen::Isometry3f& T_base_camera) {
  impl_->judge(impl_->binner.bin(cloud, T_base_camera));
  return impl_->grid;
}

const FloorGrid& FloorSegmenter::segment(const DepthView& depth,
                                         const Eigen::Isometry3f& T_base_optical) {
  impl_->judge(impl_->binner.bin(depth, T_base_optical));
  return impl_->grid;
}

}  // namespace pilothouse
