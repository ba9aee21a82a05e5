#pragma once

#include <octomap/OcTree.h>

namespace pilothouse {

/// Level of the octree whose cubes are forgotten as a whole: of 32 voxels a side.
constexpr unsigned kTileDepth = 11;

/// Removes the node at a level and all below it, and what is left without children above. OctoMap's
/// deleteNode() does so only for single voxels: of a larger cube it keeps the memory and the count.
/// @param key any within the node. @param depth of it, 1..16. @return nodes less than before.
std::size_t forgetTile(octomap::OcTree& octree, const octomap::OcTreeKey& key, unsigned depth);

}  // namespace pilothouse
