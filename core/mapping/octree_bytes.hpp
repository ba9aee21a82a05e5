#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/cloud/checked.hpp"

namespace pilothouse {

/// What a .bt file of OctoMap says of itself, once it is known to hold that.
struct OctreeHeader {
  double resolution = 0.0;      ///< edge of the smallest voxel [m], 0.001..10
  std::uint64_t nodes = 0;      ///< as counted
  std::size_t data_offset = 0;  ///< bytes from the start of the file
};

struct OctreeBounds {
  std::uint64_t max_nodes = std::uint64_t{1} << 23;
};

/// Walks a whole .bt file (Hornung et al., OctoMap, Autonomous Robots 2013; octomap.github.io) and
/// refuses, with the reason, whatever its own reader would fall for: that one follows the bits
/// wherever they lead, so that 2 MB of 0xFF make it recurse until it crashes. The header in the
/// format's order; at most 16 levels; each inner node has a child; the nodes are as many as the
/// header says; and the file ends with the last one. Allocates nothing by what the file claims.
Checked<OctreeHeader> checkOctree(std::string_view bytes, const OctreeBounds& bounds = {});

}  // namespace pilothouse
