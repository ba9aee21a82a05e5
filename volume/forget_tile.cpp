#include "volume/forget_tile.hpp"

#include <array>

namespace pilothouse {
namespace {

constexpr unsigned kLevels = 16;

/// Makes a leaf of a node, whatever is below it: with eight equal children OctoMap itself prunes
/// it, and gives their memory back.
void collapse(octomap::OcTree& octree, octomap::OcTreeNode* node) {
  for (unsigned i = 0; i < 8; ++i) {
    if (!octree.nodeChildExists(node, i)) octree.createNodeChild(node, i);
    octomap::OcTreeNode* const child = octree.getNodeChild(node, i);
    if (octree.nodeHasChildren(child)) collapse(octree, child);
    child->setLogOdds(0.0F);
  }
  octree.pruneNode(node);
}

}  // namespace

std::size_t forgetTile(octomap::OcTree& octree, const octomap::OcTreeKey& key, unsigned depth) {
  const std::size_t before = octree.size();
  std::array<octomap::OcTreeNode*, kLevels + 1> way{};
  std::array<unsigned, kLevels> child{};
  way[0] = octree.getRoot();
  if (way[0] == nullptr) return 0;
  for (unsigned level = 0; level < depth; ++level) {
    child[level] = octomap::computeChildIdx(key, static_cast<int>(kLevels - 1 - level));
    if (!octree.nodeChildExists(way[level], child[level])) return 0;
    way[level + 1] = octree.getNodeChild(way[level], child[level]);
  }
  if (octree.nodeHasChildren(way[depth])) collapse(octree, way[depth]);
  for (unsigned level = depth; level > 0; --level) {
    octree.deleteNodeChild(way[level - 1], child[level - 1]);
    if (octree.nodeHasChildren(way[level - 1])) return before - octree.size();
    collapse(octree, way[level - 1]);
  }
  octree.clear();
  return before;
}

}  // namespace pilothouse
