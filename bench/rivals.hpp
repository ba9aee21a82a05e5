#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

namespace pilothouse::bench {

/// What else a user could run on the same points to find the floor or the obstacles.
class Rivals {
 public:
  /// @param points valid points of one frame, optical frame [m].
  Rivals(const std::vector<Eigen::Vector3f>& points, const Eigen::Vector3f& camera);
  ~Rivals();
  Rivals(const Rivals&) = delete;
  Rivals& operator=(const Rivals&) = delete;

  /// PCL: voxels of 2 cm, then the plane with most inliers within 2 cm. @return inliers.
  std::size_t ransacPlane() const;
  /// PCL: voxels of 2 cm, normals of 30 neighbours, region growing. @return clusters.
  std::size_t regionGrowing() const;
  /// OctoMap: insertPointCloud with 5 cm voxels as it stands, into one map that goes on.
  /// @return nodes of the map.
  std::size_t insertOctomap();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace pilothouse::bench
