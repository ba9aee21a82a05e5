#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "core/planning/marked_map.hpp"

namespace pilothouse {

/// What may stand behind the face of a thing that the map does not have: of a box the camera sees
/// the side that it is turned to, and right beside the robot it sees nothing at all. Until the
/// floor behind such a face was seen, or was driven over, a way must not lead there.
class HiddenSides {
 public:
  static constexpr double kDepth = 0.5;  ///< things are taken to be so deep [m]

  /// @param marks what is seen and remembered now; `pose` is where the robot sees it from.
  /// @param map as it is known, without marks. @param radius of the robot [m].
  /// @return `marks`, and behind them what is hidden.
  std::vector<MapMark> behind(std::vector<MapMark> marks, const Pose2& pose, const MarkedMap& map,
                              double radius);
  void clear() { cells_.clear(); }

 private:
  using Cell = std::pair<std::int32_t, std::int32_t>;
  struct Sight;
  void cast(const MapMark& mark, const Pose2& pose, const MarkedMap& map);

  std::map<Cell, Cell> cells_;  ///< hidden, and the part of a face that hides it
};

}  // namespace pilothouse
