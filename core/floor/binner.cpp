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

bool isEmpty(const CellSlot& slot) {
  std::uint64_t any = 0;
  for (const std::uint64_t copy : slot.copies) any |= copy;
  return any == 0;
}

CellMoments unpacked(const CellSlot& slot) {
  // The copies' squares would run into the steps when added in place: two accumulators.
  constexpr std::uint64_t kSquareMask = (std::uint64_t{1} << CellSlot::kStepBit) - 1;
  constexpr int kCountShift = CellSlot::kCountBit - CellSlot::kStepBit;
  std::uint64_t squares = 0, rest = 0;
  for (const std::uint64_t copy : slot.copies) {
    squares += copy & kSquareMask;
    rest += copy >> CellSlot::kStepBit;
  }
  CellMoments moments;
  moments.count = static_cast<std::uint32_t>(rest >> kCountShift);
  moments.sum = rest & ((std::uint64_t{1} << kCountShift) - 1);
  moments.sum_square = squares;
  return moments;
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
  const bool fits = geometry_.cells() <= kMaxVectorCells && geometry_.size_x <= kMaxVectorSizeX &&
                    geometry_.size_y <= kMaxVectorSizeY;
  vector_ = fits ? vectorKernel(kernel_) : nullptr;
  const std::size_t count = vector_ == nullptr
                                ? 0
                                : (static_cast<std::size_t>(geometry_.size_x) + 2) *
                                      (static_cast<std::size_t>(geometry_.size_y) + 2);
  slots_.assign(count, CellSlot{});
  spilled_.assign(count, CellMoments{});
  sums_ = {slots_.data(), spilled_.data(), false};
}

void Binner::setPlan(const Eigen::Isometry3f& T_base_sensor) {
  const double per_cell =
      static_cast<double>(kUnitsPerCell) / static_cast<double>(geometry_.cell_size);
  const double per_step = 1.0 / static_cast<double>(scale_.step);
  plan_.column =
      fold(T_base_sensor, 0, -static_cast<double>(geometry_.x_min), per_cell, kUnitsPerCell);
  plan_.row =
      fold(T_base_sensor, 1, -static_cast<double>(geometry_.y_min), per_cell, kUnitsPerCell);
  plan_.step = fold(T_base_sensor, 2, -static_cast<double>(scale_.low), per_step, 0.5);
  plan_.column_limit = static_cast<float>(geometry_.size_x + 1) * kUnitsPerCell;
  plan_.row_limit = static_cast<float>(geometry_.size_y + 1) * kUnitsPerCell;
  const double steps =
      (static_cast<double>(scale_.high) - static_cast<double>(scale_.low)) * per_step;
  plan_.step_limit = static_cast<float>(std::min(steps, double{HeightScale::kMaxStep}) + 0.5);
  plan_.size_x = geometry_.size_x;
  plan_.size_y = geometry_.size_y;
}

void Binner::beginFrame() {
  if (vector_ == nullptr) std::fill(moments_.begin(), moments_.end(), CellMoments{});
}

/// Moves the slots' sums to the moments and leaves the slots empty for the next frame.
void Binner::endFrame() {
  if (vector_ == nullptr) return;
  const auto columns = static_cast<std::size_t>(geometry_.size_x);
  for (std::size_t iy = 0; iy < static_cast<std::size_t>(geometry_.size_y); ++iy) {
    CellSlot* slot = &slots_[(iy + 1) * (columns + 2) + 1];
    CellMoments* cell = &moments_[iy * columns];
    for (std::size_t ix = 0; ix < columns; ++ix) {
      // What the camera does not see is a large share of the cells, in long runs.
      if (isEmpty(slot[ix])) {
        cell[ix] = {};
        continue;
      }
      cell[ix] = unpacked(slot[ix]);
      slot[ix] = {};
    }
  }
  if (sums_.any_spilled) addSpilled();
  // The spare slots may keep what they have: nothing reads it, and a full one spills.
}

void Binner::addSpilled() {
  const auto columns = static_cast<std::size_t>(geometry_.size_x);
  for (std::size_t iy = 0; iy < static_cast<std::size_t>(geometry_.size_y); ++iy) {
    const CellMoments* spilled = &spilled_[(iy + 1) * (columns + 2) + 1];
    CellMoments* cell = &moments_[iy * columns];
    for (std::size_t ix = 0; ix < columns; ++ix) {
      cell[ix].count += spilled[ix].count;
      cell[ix].sum += spilled[ix].sum;
      cell[ix].sum_square += spilled[ix].sum_square;
    }
  }
  std::fill(spilled_.begin(), spilled_.end(), CellMoments{});
  sums_.any_spilled = false;
}

void Binner::add(const CloudSpan& span) {
  if (vector_ == nullptr) {
    addCloudReference(plan_, span, moments_.data());
  } else {
    vector_->add_cloud(plan_, span, sums_);
  }
}

void Binner::add(const DepthRow& row) {
  if (vector_ == nullptr) {
    addDepthReference(plan_, row, moments_.data());
  } else {
    vector_->add_depth(plan_, row, sums_);
  }
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
  endFrame();
  return moments_;
}

/// The ray through pixel (u, v) is R * ((u - cx) / fx, (v - cy) / fy, 1): a term of the column and
/// one of the row.
void Binner::setColumnTerms(const DepthView& depth) {
  const double per_pixel =
      (depth.encoding() == DepthEncoding::kMillimetres16 ? 0.001 : 1.0) / depth.intrinsics().fx;
  const BinningAxis* axes[3] = {&plan_.column, &plan_.row, &plan_.step};
  for (int axis = 0; axis < 3; ++axis) {
    column_terms_[axis].resize(paddedWidth(depth.width()) / std::size(TermBlock{}.terms));
    float* terms = column_terms_[axis].data()->terms;
    const double slope = per_pixel * static_cast<double>(axes[axis]->x);
    for (std::size_t u = 0; u < depth.width(); ++u) {
      terms[u] = static_cast<float>(slope * (static_cast<double>(u) - depth.intrinsics().cx));
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
  for (int axis = 0; axis < 3; ++axis) row.column_terms[axis] = column_terms_[axis].data()->terms;
  for (std::uint32_t v = 0; v < depth.height(); ++v) {
    row.pixels = depth.row(v);
    const double y = (static_cast<double>(v) - k.cy) / k.fy;
    for (int axis = 0; axis < 3; ++axis) {
      row.row_terms[axis] = static_cast<float>(
          unit * (static_cast<double>(axes[axis]->y) * y + static_cast<double>(axes[axis]->z)));
    }
    add(row);
  }
  endFrame();
  return moments_;
}

}  // namespace pilothouse
