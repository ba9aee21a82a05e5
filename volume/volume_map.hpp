#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "core/cloud/checked.hpp"
#include "core/cloud/depth_view.hpp"
#include "volume/volume_parameters.hpp"

namespace pilothouse {

/// The space that the camera has seen, in the map frame, as an octree (Hornung et al., OctoMap,
/// Autonomous Robots 2013). A window round the camera learns from each frame; the octree is told
/// what has changed. Bounded: by the camera's reach, and by the octree's nodes, beyond which
/// nothing new enters, and that is counted. One thread at a time.
class VolumeMap {
 public:
  /// @throws std::invalid_argument listing every fault of the parameters.
  explicit VolumeMap(const VolumeParameters& parameters);
  ~VolumeMap();

  /// @return why the frame was refused, and then nothing has changed; empty: it was not.
  std::string add(const DepthView& depth, const Eigen::Isometry3d& T_map_optical);
  void clear();

  /// Calls visit(centre [m], edge [m]) for each occupied leaf.
  void forEachOccupied(const std::function<void(const Eigen::Vector3f&, float)>& visit) const;
  bool isOccupied(const Eigen::Vector3d& place) const;
  bool isFree(const Eigen::Vector3d& place) const;

  /// The octree as a .bt file. Brings its inner nodes up to date first, which takes as long as the
  /// octree is large. @throws std::runtime_error where it cannot be written.
  std::string encode();
  /// Takes over a .bt file of the same voxel size, once it is known to be harmless.
  /// @return why not, and then the map is as it was; empty: done.
  std::string decode(std::string_view bytes);

  struct Report {
    std::size_t nodes = 0, bytes = 0;
    std::uint64_t refused_voxels = 0;   ///< that did not enter, for the octree is full of near ones
    std::uint64_t forgotten_nodes = 0;  ///< that were far, and made room
    std::uint64_t changes = 0;          ///< voxels that the octree was told of
  };
  Report report() const;
  std::uint64_t changes() const;  ///< as in the report, which takes longer the larger the octree is
  bool isEmpty() const;
  const VolumeParameters& parameters() const { return parameters_; }

 private:
  struct Tree;

  VolumeParameters parameters_;
  std::unique_ptr<Tree> tree_;
};

}  // namespace pilothouse
