#pragma once

#include <string>
#include <vector>

namespace pilothouse {

enum class FloorMethod {
  kOriginal,  ///< deviation of heights alone (KTU, 2014)
  kImproved,  ///< flood from the robot's floor, islands, drop-offs, sensor noise
};

/// What an operator must know is above the line; the rest has good defaults.
struct FloorParameters {
  FloorMethod method = FloorMethod::kImproved;
  double cell_size = 0.05;    ///< edge of a cell [m], 0.01..0.5
  double range = 4.0;         ///< farthest x of the grid [m], 0.5..20
  double half_width = 2.5;    ///< the grid covers +-half_width in y [m], 0.25..20
  double clear_height = 1.6;  ///< points above are ignored: the robot fits under [m], 0.05..3
  double threshold_deviation = 0.008;  ///< below: floor [m], 0.001..0.5
  double obstacle_deviation =
      0.015;                        ///< above: obstacle; between the two: threshold [m], 0.001..0.5
  bool calibrate_mounting = false;  ///< estimate and use camera height, pitch, roll
  // ---- advanced
  double x_min = 0.2;           ///< nearest x of the grid [m], -20..range
  double depth_below = 0.6;     ///< heights below the floor are cut at this depth [m], 0.05..2
  double step_height = 0.025;   ///< largest step between neighbouring floor cells [m], 0.002..0.5
  double seed_height = 0.06;    ///< the robot's floor lies within this of z = 0 [m], 0.005..0.5
  int min_points = 3;           ///< fewer points in a cell mean unknown, 1..1000
  double noise_floor = 0.0012;  ///< depth noise sigma(z) = floor + slope (z - 0.4)^2 [m], 0..0.1
  double noise_slope = 0.0019;  ///< [1/m], 0..0.1
};

/// Every fault of the parameters, one line each naming key, value and range; empty when sound.
std::vector<std::string> validate(const FloorParameters& parameters);

}  // namespace pilothouse
