#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "core/floor/floor_cells.hpp"

namespace pilothouse {

/// What an object means for the way that the robot goes.
enum class Relevance : std::uint8_t {
  kOther = 0,
  kPotential = 1,  ///< beside the way: the robot slows, never stops
  kInTheWay = 2,
};

/// Something that is not plain floor, as a disc on the floor of the base frame.
struct Obstacle {
  Eigen::Vector2f position{0.0F, 0.0F};                    ///< centre [m]
  float height = std::numeric_limits<float>::quiet_NaN();  ///< mean height [m]; NaN: not measured
  float size = 0.05F;                                      ///< diameter [m]
  CellClass kind = CellClass::kObstacle;                   ///< kThreshold, kObstacle or kDropOff
  std::uint8_t source = 0;                                 ///< index into Surroundings::sources
  bool remembered = false;                                 ///< not in the newest view
  Relevance relevance = Relevance::kOther;
};

/// Everything round the robot at one instant, base frame.
struct Surroundings {
  struct Source {
    std::string name;     ///< camera, or a ranger's name
    double stamp = -1.0;  ///< of its newest data [s]; negative: never came
  };
  double stamp = 0.0;  ///< the instant [s]
  std::vector<Source> sources;
  std::vector<Obstacle> objects;
};

}  // namespace pilothouse
