#include "volume/volume_map.hpp"

#include <octomap/OcTree.h>

#include <algorithm>
#include <cmath>
#include <locale>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "core/mapping/octree_bytes.hpp"
#include "volume/forget_tile.hpp"
#include "volume/volume_window.hpp"

namespace pilothouse {
namespace {

constexpr double kFarthest = 1000.0;     // [m]
constexpr std::int32_t kMiddle = 32768;  // key of voxel 0
constexpr std::int32_t kSpare =
    2 * VolumeWindow::kBlock;  // beyond the reach, not forgotten [voxels]

octomap::OcTreeKey keyOf(VoxelPlace place) {
  return {static_cast<octomap::key_type>(place.x + kMiddle),
          static_cast<octomap::key_type>(place.y + kMiddle),
          static_cast<octomap::key_type>(place.z + kMiddle)};
}

}  // namespace

struct VolumeMap::Tree {
  explicit Tree(const VolumeParameters& parameters)
      : octree(parameters.voxel), window(parameters) {}

  /// What the octree knows of a block of columns, into the window.
  void putBlock(VoxelPlace corner) {
    if (octree.size() == 0) return;
    const VoxelPlace end{corner.x + VolumeWindow::kBlock - 1, corner.y + VolumeWindow::kBlock - 1,
                         window.top() - 1};
    for (auto leaf = octree.begin_leafs_bbx(keyOf(corner), keyOf(end)),
              none = octree.end_leafs_bbx();
         leaf != none; ++leaf) {
      const Voxel judged = octree.isNodeOccupied(*leaf) ? Voxel::kOccupied : Voxel::kFree;
      const std::int32_t edge = 1 << (octree.getTreeDepth() - leaf.getDepth());
      const octomap::OcTreeKey low = leaf.getIndexKey();
      const VoxelPlace first{std::max(corner.x, low[0] - kMiddle),
                             std::max(corner.y, low[1] - kMiddle),
                             std::max(corner.z, low[2] - kMiddle)};
      for (std::int32_t z = first.z; z <= std::min(end.z, low[2] - kMiddle + edge - 1); ++z) {
        for (std::int32_t y = first.y; y <= std::min(end.y, low[1] - kMiddle + edge - 1); ++y) {
          for (std::int32_t x = first.x; x <= std::min(end.x, low[0] - kMiddle + edge - 1); ++x) {
            window.put({x, y, z}, judged);
          }
        }
      }
    }
  }

  /// The leaf or tile that lies farthest from the camera, level, and beyond the reach, if any.
  struct Tile {
    octomap::OcTreeKey low;
    unsigned depth;
    std::int32_t edge;  ///< [voxels]
  };
  std::optional<Tile> farthest(const VoxelPlace& camera, std::int32_t reach) const {
    std::optional<Tile> found;
    std::int64_t most = 0;
    for (auto leaf = octree.begin_leafs(kTileDepth), none = octree.end_leafs(); leaf != none;
         ++leaf) {
      const std::int32_t edge = 1 << (octree.getTreeDepth() - leaf.getDepth());
      const octomap::OcTreeKey low = leaf.getIndexKey();
      const auto off = [edge](std::int32_t first, std::int32_t at) {
        return std::int64_t{std::max({first - at, at - (first + edge - 1), 0})};
      };
      const std::int64_t x = off(low[0] - kMiddle, camera.x), y = off(low[1] - kMiddle, camera.y);
      if (x * x + y * y <= most || std::max(x, y) <= reach) continue;
      most = x * x + y * y;
      found = Tile{low, leaf.getDepth(), edge};
    }
    return found;
  }

  /// Until so many nodes more would fit; a little at a time, as much as comes in.
  void makeRoom(std::size_t nodes, std::size_t most_nodes, const VoxelPlace& camera,
                std::int32_t reach) {
    while (octree.size() + nodes > most_nodes) {
      const auto tile = farthest(camera, reach);
      if (!tile) return;
      forgotten_nodes += forgetTile(octree, tile->low, tile->depth);
      window.forget({tile->low[0] - kMiddle, tile->low[1] - kMiddle, 0}, tile->edge);
    }
  }

  octomap::OcTree octree;
  VolumeWindow window;
  std::uint64_t refused_voxels = 0, forgotten_nodes = 0, changes = 0;
};

VolumeMap::VolumeMap(const VolumeParameters& parameters) : parameters_(parameters) {
  std::string all;
  for (const auto& fault : validate(parameters)) all += (all.empty() ? "" : "; ") + fault;
  if (!all.empty()) throw std::invalid_argument(all);
  tree_ = std::make_unique<Tree>(parameters);
}
VolumeMap::~VolumeMap() = default;

std::string VolumeMap::add(const DepthView& depth, const Eigen::Isometry3d& T_map_optical) {
  const Eigen::Vector3d camera = T_map_optical.translation();
  if (!T_map_optical.matrix().allFinite() || camera.cwiseAbs().maxCoeff() > kFarthest) {
    return "the camera's pose is not finite or farther than 1 km";
  }
  if (camera.z() < -parameters_.below || camera.z() > parameters_.above - parameters_.voxel) {
    return "the camera is " + std::to_string(camera.z()) + " m high, expected within the map's " +
           std::to_string(-parameters_.below) + " to " + std::to_string(parameters_.above);
  }
  for (const VoxelPlace block : tree_->window.moveTo(camera)) tree_->putBlock(block);
  const auto& changes = tree_->window.add(depth, T_map_optical);
  octomap::OcTree& octree = tree_->octree;
  const auto most = static_cast<std::size_t>(parameters_.max_nodes);
  tree_->makeRoom(changes.size() + changes.size() / 4, most, tree_->window.centre(),
                  static_cast<std::int32_t>(parameters_.reach / parameters_.voxel) + kSpare);
  for (const auto& change : changes) {
    const octomap::OcTreeKey key = keyOf(change.place);
    if (octree.size() >= most && octree.search(key) == nullptr) {
      ++tree_->refused_voxels;
      tree_->window.put(change.place, Voxel::kUnknown);  // to be told again when there is room
      continue;
    }
    octree.setNodeValue(key,
                        change.judged == Voxel::kOccupied ? octree.getClampingThresMaxLog()
                                                          : octree.getClampingThresMinLog(),
                        true);
  }
  tree_->changes += changes.size();
  return {};
}

void VolumeMap::clear() {
  tree_ = std::make_unique<Tree>(parameters_);
}

void VolumeMap::forEachOccupied(
    const std::function<void(const Eigen::Vector3f&, float)>& visit) const {
  const octomap::OcTree& octree = tree_->octree;
  for (auto leaf = octree.begin_leafs(), end = octree.end_leafs(); leaf != end; ++leaf) {
    if (!octree.isNodeOccupied(*leaf)) continue;
    const octomap::point3d at = leaf.getCoordinate();
    visit({at.x(), at.y(), at.z()}, static_cast<float>(leaf.getSize()));
  }
}

bool VolumeMap::isOccupied(const Eigen::Vector3d& place) const {
  const auto* node = tree_->octree.search(place.x(), place.y(), place.z());
  return node != nullptr && tree_->octree.isNodeOccupied(node);
}

bool VolumeMap::isFree(const Eigen::Vector3d& place) const {
  const auto* node = tree_->octree.search(place.x(), place.y(), place.z());
  return node != nullptr && !tree_->octree.isNodeOccupied(node);
}

std::string VolumeMap::encode() {
  tree_->octree.updateInnerOccupancy();
  tree_->octree.prune();
  // writeBinary() says success whatever becomes of the stream, and talks to the terminal.
  std::ostringstream stream;
  stream.imbue(std::locale::classic());
  stream << "# Octomap OcTree binary file\n# (feel free to add / change comments, but leave the "
            "first line as it is!)\n#\nid OcTree\nsize "
         << tree_->octree.size() << "\nres " << tree_->octree.getResolution() << "\ndata\n";
  tree_->octree.writeBinaryData(stream);
  if (!stream.good()) throw std::runtime_error("the octree cannot be written");
  std::string bytes = stream.str();
  const auto header = checkOctree(bytes);
  if (!header) throw std::runtime_error("the octree was written wrongly: " + header.reason());
  return bytes;
}

std::string VolumeMap::decode(std::string_view bytes) {
  const auto header = checkOctree(bytes, {static_cast<std::uint64_t>(parameters_.max_nodes)});
  if (!header) return header.reason();
  if (std::abs(header->resolution - parameters_.voxel) > 1e-6) {
    return "res is " + std::to_string(header->resolution) + ", expected " +
           std::to_string(parameters_.voxel) + " as configured";
  }
  auto tree = std::make_unique<Tree>(parameters_);
  if (header->nodes > 0) {
    std::istringstream stream{std::string(bytes.substr(header->data_offset))};
    tree->octree.readBinaryData(stream);
    if (!stream || tree->octree.size() != header->nodes) return "OctoMap cannot read it";
  }
  tree_ = std::move(tree);
  return {};
}

std::uint64_t VolumeMap::changes() const {
  return tree_->changes;
}

bool VolumeMap::isEmpty() const {
  return tree_->octree.size() == 0;
}

VolumeMap::Report VolumeMap::report() const {
  return {tree_->octree.size(), tree_->octree.memoryUsage(), tree_->refused_voxels,
          tree_->forgotten_nodes, tree_->changes};
}

}  // namespace pilothouse
