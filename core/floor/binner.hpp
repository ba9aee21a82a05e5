#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "core/cloud/cloud_view.hpp"
#include "core/cloud/depth_view.hpp"
#include "core/floor/cell_moments.hpp"
#include "core/floor/floor_grid.hpp"

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

/// Sorts points into the cells of a grid on the floor and sums their heights. Keeps its memory.
/// Points that are not finite, outside the grid or above the scale's high are left out.
class Binner {
 public:
  void configure(const GridGeometry& geometry, const HeightScale& scale);
  void useKernel(BinningKernel kernel) { kernel_ = kernel; }

  /// @param T_base_camera finite; takes the cloud's points to the base frame [m].
  /// @return geometry.cells() sums, valid until the next call.
  const std::vector<CellMoments>& bin(const CloudView& cloud,
                                      const Eigen::Isometry3f& T_base_camera);
  const std::vector<CellMoments>& bin(const DepthView& depth,
                                      const Eigen::Isometry3f& T_base_optical);

 private:
  void add(float x, float y, float z);

  GridGeometry geometry_;
  HeightScale scale_;
  BinningKernel kernel_ = fastestKernel();
  std::vector<CellMoments> moments_;
};

}  // namespace pilothouse
