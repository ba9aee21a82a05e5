#include "core/floor/floor_parameters.hpp"

#include <cmath>
#include <sstream>

namespace pilothouse {
namespace {

constexpr double kMaxCells = 1e6;

void require(std::vector<std::string>& faults, const char* key, double value, double low,
             double high) {
  if (std::isfinite(value) && value >= low && value <= high) return;
  std::ostringstream line;
  line << key << " is " << value << ", expected " << low << " to " << high;
  faults.push_back(line.str());
}

}  // namespace

std::vector<std::string> validate(const FloorParameters& p) {
  std::vector<std::string> faults;
  require(faults, "cell_size", p.cell_size, 0.01, 0.5);
  require(faults, "range", p.range, 0.5, 20.0);
  require(faults, "half_width", p.half_width, 0.25, 20.0);
  require(faults, "clear_height", p.clear_height, 0.05, 3.0);
  require(faults, "threshold_deviation", p.threshold_deviation, 0.001, 0.5);
  require(faults, "obstacle_deviation", p.obstacle_deviation, 0.001, 0.5);
  require(faults, "x_min", p.x_min, -20.0, 19.9);
  require(faults, "depth_below", p.depth_below, 0.05, 2.0);
  require(faults, "step_height", p.step_height, 0.002, 0.5);
  require(faults, "seed_height", p.seed_height, 0.005, 0.5);
  require(faults, "min_points", p.min_points, 1, 1000);
  require(faults, "noise_floor", p.noise_floor, 0.0, 0.1);
  require(faults, "noise_slope", p.noise_slope, 0.0, 0.1);
  if (!faults.empty()) return faults;
  if (p.obstacle_deviation < p.threshold_deviation) {
    require(faults, "obstacle_deviation", p.obstacle_deviation, p.threshold_deviation, 0.5);
  }
  if (p.x_min > p.range - p.cell_size) {
    require(faults, "x_min", p.x_min, -20.0, p.range - p.cell_size);
  }
  const double cells = (p.range - p.x_min) / p.cell_size * (2.0 * p.half_width / p.cell_size);
  if (cells > kMaxCells) {
    std::ostringstream line;
    line << "cell_size is " << p.cell_size << " and makes a grid of " << cells
         << " cells, expected at most " << kMaxCells;
    faults.push_back(line.str());
  }
  return faults;
}

}  // namespace pilothouse
