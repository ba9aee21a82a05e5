#include "core/floor/floor_segmenter.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/floor/cell_statistics.hpp"
#include "core/floor/improved_method.hpp"
#include "core/floor/near_floor.hpp"
#include "core/floor/original_method.hpp"

namespace pilothouse {
namespace {

constexpr double kFinestStep = 0.001;  // heights are counted in steps of 1 mm where they fit [m]

GridGeometry geometryOf(const FloorParameters& p) {
  GridGeometry g;
  g.cell_size = static_cast<float>(p.cell_size);
  g.x_min = static_cast<float>(p.x_min);
  g.y_min = static_cast<float>(-p.half_width);
  g.size_x = static_cast<int>(std::lround((p.range - p.x_min) / p.cell_size));
  g.size_y = static_cast<int>(std::lround(2.0 * p.half_width / p.cell_size));
  return g;
}

HeightScale scaleOf(const FloorParameters& p) {
  HeightScale scale;
  scale.low = static_cast<float>(-p.depth_below);
  scale.high = static_cast<float>(p.clear_height);
  scale.step = static_cast<float>(
      std::max(kFinestStep, (p.clear_height + p.depth_below) / HeightScale::kMaxStep));
  return scale;
}

}  // namespace

struct FloorSegmenter::Impl {
  FloorParameters parameters;
  HeightScale scale;
  Binner binner;
  ImprovedMethod improved;
  MountingCalibrator calibrator;
  NearFloor near_floor;
  std::vector<std::uint8_t> is_floor;
  FloorCells grid;
  Eigen::Isometry3f T_used = Eigen::Isometry3f::Identity();

  /// @return the plane that the robot stands on, where it shows.
  std::optional<FloorSlope> judge() {
    if (parameters.method == FloorMethod::kImproved) return improved.judge(T_used, grid);
    judgeOriginal(parameters, grid);
    for (std::size_t i = 0; i < is_floor.size(); ++i) is_floor[i] = isDrivable(grid.classes[i]);
    return near_floor.fit(is_floor, grid);
  }

  template <class View>
  const FloorCells& segment(const View& view, const Eigen::Isometry3f& T_configured) {
    T_used = parameters.calibrate_mounting ? calibrator.corrected(T_configured) : T_configured;
    fillStatistics(binner.bin(view, T_used), scale, parameters.min_points, grid);
    if (const auto plane = judge()) calibrator.add(*plane, T_used, T_configured);
    return grid;
  }
};

FloorSegmenter::FloorSegmenter(const FloorParameters& parameters)
    : impl_(std::make_unique<Impl>()) {
  setParameters(parameters);
}
FloorSegmenter::~FloorSegmenter() = default;

void FloorSegmenter::setParameters(const FloorParameters& p) {
  const auto faults = validate(p);
  if (!faults.empty()) {
    std::string text = "floor parameters:";
    for (const auto& fault : faults) text += ' ' + fault + ';';
    throw std::invalid_argument(text);
  }
  impl_->parameters = p;
  impl_->scale = scaleOf(p);
  FloorCells& grid = impl_->grid;
  grid.geometry = geometryOf(p);
  impl_->binner.configure(grid.geometry, impl_->scale);
  impl_->improved.configure(p, grid.geometry);
  impl_->near_floor.configure(grid.geometry);
  impl_->is_floor.assign(grid.geometry.cells(), 0);
  grid.classes.assign(grid.geometry.cells(), CellClass::kUnknown);
  grid.heights.assign(grid.geometry.cells(), 0.0F);
  grid.deviations.assign(grid.geometry.cells(), 0.0F);
  grid.counts.assign(grid.geometry.cells(), 0);
}

const FloorParameters& FloorSegmenter::parameters() const {
  return impl_->parameters;
}
void FloorSegmenter::useKernel(BinningKernel kernel) {
  impl_->binner.useKernel(kernel);
}
const MountingEstimate& FloorSegmenter::mounting() const {
  return impl_->calibrator.estimate();
}
const Eigen::Isometry3f& FloorSegmenter::mountingUsed() const {
  return impl_->T_used;
}
void FloorSegmenter::reset() {
  impl_->calibrator.reset();
}

const FloorCells& FloorSegmenter::segment(const CloudView& cloud,
                                          const Eigen::Isometry3f& T_base_camera) {
  return impl_->segment(cloud, T_base_camera);
}

const FloorCells& FloorSegmenter::segment(const DepthView& depth,
                                          const Eigen::Isometry3f& T_base_optical) {
  return impl_->segment(depth, T_base_optical);
}

}  // namespace pilothouse
