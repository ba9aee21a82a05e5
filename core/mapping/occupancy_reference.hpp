#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "core/mapping/occupancy_map.hpp"

namespace pilothouse {

/// What OccupancyMap does, written down plainly: one map entry a cell, no blocks and no window. The
/// tests compare the two, the benchmark times them beside each other.
class OccupancyReference {
 public:
  explicit OccupancyReference(const OccupancyParameters& parameters)
      : parameters_(parameters), rule_(parameters) {}

  void addFloor(const FloorFrame& frame, const Pose2& T_map_base);
  void addScan(const PlanarScan& scan, const Pose2& T_map_base);
  void addObjects(const std::vector<Obstacle>& objects, const Pose2& T_map_base);

  using Cells = std::map<std::pair<std::int32_t, std::int32_t>, MapCellState>;
  const Cells& cells() const { return cells_; }

 private:
  using Evidence = std::map<std::pair<std::int32_t, std::int32_t>, CellEvidence>;
  void learn(const Evidence& evidence, const FloorFrame* frame, const Pose2& pose);
  bool isInside(std::int32_t ix, std::int32_t iy) const;

  OccupancyParameters parameters_;
  CellRule rule_;
  Cells cells_;
};

}  // namespace pilothouse
