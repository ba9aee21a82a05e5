#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/cloud/depth_view.hpp"
#include "volume/volume_parameters.hpp"

namespace pilothouse {

/// Place of a voxel in the endless grid: voxel (x, y, z) covers [x, x + 1) * its edge and the like.
struct VoxelPlace {
  std::int32_t x = 0, y = 0, z = 0;
};

enum class Voxel : std::uint8_t { kUnknown = 0, kFree = 1, kOccupied = 2 };

/// What the camera has seen of the space round it, voxel by voxel, in a window that goes along: the
/// octree need only be told where something is judged otherwise than it has it. Fixed size:
/// allocates when made, and where a frame touches more than any before.
class VolumeWindow {
 public:
  explicit VolumeWindow(const VolumeParameters& parameters);

  /// Columns of voxels that came into the window with a move of the camera: what is known of them
  /// must be put(), or they begin unknown. @return the lower corner of each block of kBlock x
  /// kBlock columns.
  static constexpr std::int32_t kBlock = 8;
  const std::vector<VoxelPlace>& moveTo(const Eigen::Vector3d& camera);
  void put(VoxelPlace place, Voxel judged);
  /// Columns of a square come in anew with the next move. @param low its lower corner.
  void forget(VoxelPlace low, std::int32_t edge);
  VoxelPlace centre() const { return centre_; }  ///< the camera's voxel

  /// One frame from where moveTo() went: of all pixels that end in a voxel one is taken, along
  /// which everything before is free. Beyond the reach, and above and below the map, a ray ends
  /// without having met anything. @return what changed, valid until the next call.
  struct Change {
    VoxelPlace place;
    Voxel judged;
  };
  const std::vector<Change>& add(const DepthView& depth, const Eigen::Isometry3d& T_map_optical);
  void clear();

  std::int32_t bottom() const { return bottom_; }  ///< lowest voxel, and ...
  std::int32_t top() const { return top_; }        ///< ... the one above the highest
  bool contains(VoxelPlace place) const;

 private:
  struct Ray {
    Eigen::Vector3f end;  ///< in voxels
    bool hit;
  };
  std::size_t slot(std::int32_t x, std::int32_t y, std::int32_t z) const {
    return (static_cast<std::size_t>(y & (side_ - 1)) * static_cast<std::size_t>(side_) +
            static_cast<std::size_t>(x & (side_ - 1))) *
               static_cast<std::size_t>(height_) +
           static_cast<std::size_t>((z - bottom_) & (height_ - 1));
  }
  void collectRays(const DepthView& depth, const Eigen::Isometry3f& T_voxels_optical);
  void aim(const Eigen::Vector3f& from, Eigen::Vector3f end, bool hit);
  void walk(const Eigen::Vector3f& from, const Ray& ray);
  void learn();

  VolumeParameters parameters_;
  int hit_, miss_, most_, occupied_, free_;    ///< log-odds [0.05]
  std::int32_t side_, height_, bottom_, top_;  ///< voxels
  std::vector<std::int8_t> odds_;              ///< log-odds [0.05]
  std::vector<std::uint8_t> marks_;            ///< of this frame, and what was judged last
  std::vector<std::uint64_t> owners_;          ///< which block of the endless grid is kept here
  std::vector<VoxelPlace> entered_;
  std::vector<Ray> rays_;
  std::vector<VoxelPlace> touched_;
  std::vector<Change> changes_;
  VoxelPlace centre_;
};

}  // namespace pilothouse
