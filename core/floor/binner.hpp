#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "core/cloud/cloud_view.hpp"
#include "core/cloud/depth_view.hpp"
#include "core/floor/binning_kernel.hpp"
#include "core/floor/cell_moments.hpp"
#include "core/floor/floor_cells.hpp"

namespace pilothouse {

/// Which code sorts points into cells. All give the same sums, bit for bit.
enum class BinningKernel {
  kReference,  ///< plain loop, the definition
  kSse4,
  kAvx2,
};

/// The fastest kernel that this processor runs.
BinningKernel fastestKernel();
bool isSupported(BinningKernel kernel);

/// Sorts points into the cells of a grid on the floor and sums their heights. Keeps its memory: no
/// allocation after the first frame of a size. Points that are not finite, outside the grid or
/// above the scale's high are left out; points below its low count as that low.
class Binner {
 public:
  /// Grids of more cells go through the reference: a vector kernel's sums take 64 bytes a cell,
  /// which would no longer fit a cache.
  static constexpr std::size_t kMaxVectorCells = std::size_t{1} << 18;

  void configure(const GridGeometry& geometry, const HeightScale& scale);
  /// @param kernel one that isSupported(); any other means the reference.
  void useKernel(BinningKernel kernel);
  BinningKernel kernel() const { return kernel_; }

  /// @param T_base_camera finite; takes the cloud's points to the base frame [m].
  /// @return geometry.cells() sums, valid until the next call.
  const std::vector<CellMoments>& bin(const CloudView& cloud,
                                      const Eigen::Isometry3f& T_base_camera);
  const std::vector<CellMoments>& bin(const DepthView& depth,
                                      const Eigen::Isometry3f& T_base_optical);

 private:
  void setPlan(const Eigen::Isometry3f& T_base_sensor);
  void setColumnTerms(const DepthView& depth);
  void choose();
  void beginFrame();
  void add(const CloudSpan& span);
  void add(const DepthRow& row);
  void endFrame();
  void addSpilled();

  GridGeometry geometry_;
  HeightScale scale_;
  BinningKernel kernel_ = fastestKernel();
  const VectorKernel* vector_ = nullptr;  ///< nullptr: the reference
  BinningPlan plan_{};
  std::vector<CellMoments> moments_;
  std::vector<CellSlot> slots_;
  std::vector<CellMoments> spilled_;
  BinningSums sums_{};
  /// Whole vectors, so that no load straddles two cache lines.
  struct alignas(64) TermBlock {
    float terms[16];
  };
  std::vector<TermBlock> column_terms_[3];  ///< grid coordinates a unit of depth, a column each
};

}  // namespace pilothouse
