#pragma once

#include <cstdint>
#include <vector>

#include "core/floor/floor_cells.hpp"

namespace pilothouse {

/// Where the beams of a virtual scan point: beam i covers the bearings angle_min + (i -+ 1/2) *
/// increment [rad], 0 forward, counter-clockwise.
struct ScanGeometry {
  float angle_min = 0.0F;  ///< centre of the first beam [rad]
  float increment = 0.0F;  ///< [rad]
  int beams = 0;
  float range_max = 0.0F;  ///< farthest corner of the grid [m]
};

/// What a laser at the robot's origin would see of the judged floor. A beam's range is the distance
/// to the nearest point of the nearest obstacle or drop-off cell that its sector touches, so that
/// nothing of the grid falls between two beams. Otherwise, after REP 117:
/// +infinity: drivable cells were seen in the sector and nothing else; NaN: nothing was seen there,
/// which is no measurement and must not clear a map; -infinity: the robot's origin lies inside an
/// obstacle cell. How far the drivable cells reach a scan cannot say; the grid can.
/// Keeps its memory: no allocation while the grid's geometry stays.
class VirtualScan {
 public:
  /// @return one range a beam [m], valid until the next call.
  const std::vector<float>& scan(const FloorCells& grid);
  /// Of the last scan.
  const ScanGeometry& geometry() const { return scan_; }

 private:
  /// The beams that a cell touches, going round, and the distance to its nearest point.
  struct Sector {
    std::uint16_t first = 0;
    std::uint16_t count = 0;
    float distance = 0.0F;  ///< [m]
  };
  void prepare(const GridGeometry& grid);
  Sector sectorOf(const GridGeometry& grid, int ix, int iy) const;

  GridGeometry grid_;
  ScanGeometry scan_;
  std::vector<Sector> sectors_;  ///< one a cell
  std::vector<float> ranges_;
};

}  // namespace pilothouse
