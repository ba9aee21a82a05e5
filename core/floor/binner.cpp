#include "core/floor/binner.hpp"

#include <algorithm>
#include <cstring>

namespace pilothouse {
namespace {

const VectorKernel* vectorKernel(BinningKernel kernel) {
#if defined(__x86_64__) || defined(__i386__)
  if (kernel == BinningKernel::kAvx2 && __builtin_cpu_supports("avx2")) return avx2BinningKernel();
  if (kernel == BinningKernel::kSse4 && __builtin_cpu_supports("sse4.1"))
    return sse4BinningKernel();
#else
  static_cast<void>(kernel);
#endif
  return nullptr;
}

/// Folds `scale * (row . T * p + shift)` into one axis; in double, so that only the result rounds.
BinningAxis fold(const Eigen::Isometry3f& T_base_sensor, int row, double shift, double scale,
                 double bias) {
  const Eigen::RowVector4d r = T_base_sensor.matrix().row(row).cast<double>();
  return {static_cast<float>(scale * r[0]), static_cast<float>(scale * r[1]),
          static_cast<float>(scale * r[2]), static_cast<float>(scale * (r[3] + shift) + bias)};
}

}  // namespace

BinningKernel fastestKernel() {
  for (const auto kernel : {BinningKernel::kAvx2, BinningKernel::kSse4}) {
    if (isSupported(kernel)) return kernel;
  }
  return BinningKernel::kReference;
}

bool isSupported(BinningKernel kernel) {
  return kernel == BinningKernel::kReference || vectorKernel(kernel) != nullptr;
}

void Binner::configure(const GridGeometry& geometry, const HeightScale& scale) {
  geometry_ = geometry;
  scale_ = scale;
  moments_.assign(geometry.cells(), CellMoments{});
  choose();
}

void Binner::useKernel(BinningKernel kernel) {
  kernel_ = isSupported(kernel) ? kernel : BinningKernel::kReference;
  choose();
}

void Binner::choose() {
  vector_ = geometry_.cells() <= kMaxVectorCells ? vectorKernel(kernel_) : nullptr;
  const auto columns = static_cast<std::size_t>(geometry_.size_x) + 1;
  const auto rows = static_cast<std::size_t>(geometry_.size_y) + 1;
  slots_.assign(vector_ != nullptr ? columns * rows : 0, CellSlot{});
  points_in_slots_ = 0;
}

void Binner::setPlan(const Eigen::Isometry3f& T_base_sensor) {
  const double per_cell = 1.0 / static_cast<double>(geometry_.cell_size);
  const double per_step = 1.0 / static_cast<double>(scale_.step);
  plan_.column = fold(T_base_sensor, 0, -static_cast<double>(geometry_.x_min), per_cell, 1.0);
  plan_.row = fold(T_base_sensor, 1, -static_cast<double>(geometry_.y_min), per_cell, 1.0);
  plan_.step = fold(T_base_sensor, 2, -static_cast<double>(scale_.low), per_step, 0.5);
  plan_.column_limit = static_cast<float>(geometry_.size_x) + 1.0F;
  plan_.row_limit = static_cast<float>(geometry_.size_y) + 1.0F;
  plan_.step_limit = static_cast<float>(
      (static_cast<double>(scale_.high) - static_cast<double>(scale_.low)) * per_step + 0.5);
  plan_.size_x = geometry_.size_x;
}

void Binner::beginFrame() {
  std::fill(moments_.begin(), moments_.end(), CellMoments{});
}

void Binner::makeRoomFor(std::size_t points) {
  if (points_in_slots_ + points > kMaxPointsInSlots) emptySlots();
  points_in_slots_ += points;
}

/// Adds the slots to the moments and leaves them empty for the next points.
void Binner::emptySlots() {
  points_in_slots_ = 0;
  const auto columns = static_cast<std::size_t>(geometry_.size_x);
  for (std::size_t iy = 0; iy < static_cast<std::size_t>(geometry_.size_y); ++iy) {
    CellSlot* slot = &slots_[(iy + 1) * (columns + 1) + 1];
    CellMoments* cell = &moments_[iy * columns];
    for (std::size_t ix = 0; ix < columns; ++ix, ++slot, ++cell) {
      for (CellSlot::Copy& copy : slot->copies) {
        cell->count += copy.count;
        cell->sum += copy.sum;
        cell->sum_square += copy.sum_square;
        copy = {};
      }
    }
  }
  // The spare slots are never read, but their sums must not run over.
  for (std::size_t i = 0; i <= columns; ++i) slots_[i] = {};
  for (std::size_t i = 0; i < slots_.size(); i += columns + 1) slots_[i] = {};
}

void Binner::add(CloudSpan span) {
  if (vector_ == nullptr) return addCloudReference(plan_, span, moments_.data());
  while (span.points > 0) {
    CloudSpan part = span;
    part.points = std::min(span.points, kMaxPointsInSlots);
    makeRoomFor(part.points);
    vector_->add_cloud(plan_, part, slots_.data());
    span.first += part.points * span.stride;
    span.points -= part.points;
  }
}

void Binner::add(const DepthRow& row) {
  if (vector_ == nullptr) return addDepthReference(plan_, row, moments_.data());
  makeRoomFor(paddedWidth(row.width));
  vector_->add_depth(plan_, row, slots_.data());
}

const std::vector<CellMoments>& Binner::bin(const CloudView& cloud,
                                            const Eigen::Isometry3f& T_base_camera) {
  setPlan(T_base_camera);
  beginFrame();
  CloudSpan span{nullptr,         cloud.width(),   cloud.pointStep(),
                 cloud.xOffset(), cloud.yOffset(), cloud.zOffset()};
  const bool gapless =
      cloud.rowStep() == static_cast<std::uint64_t>(cloud.width()) * cloud.pointStep();
  if (gapless) span.points = cloud.points();
  for (std::uint32_t row = 0; row < (gapless ? std::min(1U, cloud.height()) : cloud.height());
       ++row) {
    span.first = cloud.row(row);
    add(span);
  }
  if (vector_ != nullptr) emptySlots();
  return moments_;
}

/// The ray through pixel (u, v) is R * ((u - cx) / fx, (v - cy) / fy, 1): a term of the column and
/// one of the row.
void Binner::setColumnTerms(const DepthView& depth) {
  const double per_pixel =
      (depth.encoding() == DepthEncoding::kMillimetres16 ? 0.001 : 1.0) / depth.intrinsics().fx;
  const BinningAxis* axes[3] = {&plan_.column, &plan_.row, &plan_.step};
  for (int axis = 0; axis < 3; ++axis) {
    column_terms_[axis].resize(paddedWidth(depth.width()));
    const double slope = per_pixel * static_cast<double>(axes[axis]->x);
    for (std::size_t u = 0; u < column_terms_[axis].size(); ++u) {
      column_terms_[axis][u] =
          static_cast<float>(slope * (static_cast<double>(u) - depth.intrinsics().cx));
    }
  }
}

const std::vector<CellMoments>& Binner::bin(const DepthView& depth,
                                            const Eigen::Isometry3f& T_base_optical) {
  setPlan(T_base_optical);
  setColumnTerms(depth);
  beginFrame();
  const Intrinsics& k = depth.intrinsics();
  DepthRow row{};
  row.width = depth.width();
  row.millimetres16 = depth.encoding() == DepthEncoding::kMillimetres16;
  const double unit = row.millimetres16 ? 0.001 : 1.0;
  const BinningAxis* axes[3] = {&plan_.column, &plan_.row, &plan_.step};
  for (int axis = 0; axis < 3; ++axis) row.column_terms[axis] = column_terms_[axis].data();
  for (std::uint32_t v = 0; v < depth.height(); ++v) {
    row.pixels = depth.row(v);
    const double y = (static_cast<double>(v) - k.cy) / k.fy;
    for (int axis = 0; axis < 3; ++axis) {
      row.row_terms[axis] = static_cast<float>(
          unit * (static_cast<double>(axes[axis]->y) * y + static_cast<double>(axes[axis]->z)));
    }
    add(row);
  }
  if (vector_ != nullptr) emptySlots();
  return moments_;
}

}  // namespace pilothouse
