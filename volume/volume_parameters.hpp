#pragma once

#include <string>
#include <vector>

namespace pilothouse {

/// What an operator must know is above the line; the rest has good defaults.
struct VolumeParameters {
  double voxel = 0.05;      ///< edge [m], 0.02..0.5
  double reach = 4.0;       ///< what is farther from the camera does not enter [m], 0.5..8
  double below = 0.6;       ///< the map reaches so far below its frame's z = 0 [m], 0..5
  double above = 2.0;       ///< and so far above [m], 0.1..5
  int max_nodes = 4000000;  ///< of the octree; then what is far is forgotten, 1000..8000000
  // ---- advanced; evidence in log-odds, ln(p / (1 - p)), kept in steps of 0.05
  double hit = 0.5;       ///< of one look at something, 0.05..3
  double miss = 0.6;      ///< of one look through, 0.05..3
  double most = 1.9;      ///< evidence never goes beyond +-most, 0.1..6
  double occupied = 0.6;  ///< from here on a voxel is occupied, 0.05..most
  double free = 0.4;      ///< below -free it is free, 0.05..most
};

template <class Parameters, class Visit>
void forEachVolumeParameter(Parameters& p, Visit visit) {
  visit("voxel", p.voxel, 0.02, 0.5);
  visit("reach", p.reach, 0.5, 8.0);
  visit("below", p.below, 0.0, 5.0);
  visit("above", p.above, 0.1, 5.0);
  visit("max_nodes", p.max_nodes, 1000, 8000000);
  visit("hit", p.hit, 0.05, 3.0);
  visit("miss", p.miss, 0.05, 3.0);
  visit("most", p.most, 0.1, 6.0);
  visit("occupied", p.occupied, 0.05, 6.0);
  visit("free", p.free, 0.05, 6.0);
}

/// Every fault, one line each naming key, value and range; empty when sound.
std::vector<std::string> validate(const VolumeParameters& parameters);

}  // namespace pilothouse
