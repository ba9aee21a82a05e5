#pragma once

#include <string>
#include <vector>

namespace pilothouse {

/// What an operator must know is above the line; the rest has good defaults.
struct OccupancyParameters {
  double cell_size = 0.05;   ///< edge of a cell [m], 0.01..0.5
  double max_side = 100.0;   ///< the map never leaves the square of this side round the map frame's
                             ///< origin [m], 1..1000
  double reach = 8.0;        ///< what is farther from the robot does not enter [m], 0.5..30
  double clear_range = 4.0;  ///< a beam without a return clears no farther than this [m], 0..30
  // ---- advanced; evidence in log-odds, ln(p / (1 - p)), kept in steps of 0.01
  double hit = 0.9;       ///< of one look at something, 0.05..10
  double miss = 0.8;      ///< of one look at free floor, 0.05..10
  double most = 1.9;      ///< evidence never goes beyond +-most: three looks turn it, 0.1..30
  double occupied = 0.6;  ///< from here on a cell is occupied, 0.05..most
  double free = 0.4;      ///< below -free it is free, 0.05..most
  double passing = 0.4;   ///< what a floor grid alone shows, and has not stayed, brings no cell
                          ///< beyond this, 0..most; below `occupied`: people leave no traces
};

/// Calls visit(key, value, low, high) for every number of the parameters. `p` may be const.
template <class Parameters, class Visit>
void forEachOccupancyParameter(Parameters& p, Visit visit) {
  visit("cell_size", p.cell_size, 0.01, 0.5);
  visit("max_side", p.max_side, 1.0, 1000.0);
  visit("reach", p.reach, 0.5, 30.0);
  visit("clear_range", p.clear_range, 0.0, 30.0);
  visit("hit", p.hit, 0.05, 10.0);
  visit("miss", p.miss, 0.05, 10.0);
  visit("most", p.most, 0.1, 30.0);
  visit("occupied", p.occupied, 0.05, 30.0);
  visit("free", p.free, 0.05, 30.0);
  visit("passing", p.passing, 0.0, 30.0);
}

/// Every fault, one line each naming key, value and range; empty when sound.
std::vector<std::string> validate(const OccupancyParameters& parameters);

}  // namespace pilothouse
