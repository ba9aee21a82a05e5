#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "core/cloud/cloud_view.hpp"
#include "core/cloud/depth_view.hpp"
#include "core/floor/virtual_scan.hpp"

namespace pilothouse {

/// Heights are above the base frame's origin, which lies on the floor.
struct LevelScanParameters {
  float low = 0.12F, high = 0.6F;  ///< what is between counts [m]
  float range_max = 6.0F;          ///< farther a depth camera measures too badly [m]
  int fewest = 4;                  ///< points, of a beam that met something
};

/// What a level laser at the robot's origin would see, made of the points that a depth camera sees
/// between two heights: unlike VirtualScan, which tells cells, it measures, and so is made for
/// finding a pose. A beam's range is the mean of the nearest surface in its sector: many points of
/// a wall make one good measurement of noisy ones. NaN: none. Nothing of it says that a way is
/// free. Keeps its memory: no allocation after the first picture.
class LevelScan {
 public:
  explicit LevelScan(const LevelScanParameters& parameters = {});

  /// @param T_base_optical from the optical frame (x right, y down, z forward).
  /// @return one range a beam [m], valid until the next call.
  const std::vector<float>& scan(const DepthView& depth, const Eigen::Isometry3f& T_base_optical);
  const std::vector<float>& scan(const CloudView& cloud, const Eigen::Isometry3f& T_base_camera);
  const ScanGeometry& geometry() const { return geometry_; }

 private:
  struct Hit {
    std::uint32_t beam;
    float range;  ///< in the plane [m]
  };
  /// @param most points that can come.
  void begin(std::size_t most);
  void add(const Eigen::Vector3f& point);
  const std::vector<float>& end();
  /// Of one beam's points, which it puts in another order; NaN: too few.
  float surfaceOf(std::vector<float>::iterator first, std::vector<float>::iterator last) const;

  LevelScanParameters parameters_;
  ScanGeometry geometry_;
  std::vector<Hit> hits_;
  std::vector<float> sorted_;        ///< ranges, beam after beam
  std::vector<std::uint32_t> ends_;  ///< of each beam in these
  std::vector<float> ranges_;
};

}  // namespace pilothouse
