#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "sim/floor_scene.hpp"
#include "sim/world_scene.hpp"

namespace pilothouse::sim {

/// What the rays of one picture met, a pixel each, row by row.
struct CameraHits {
  static constexpr std::uint32_t kNothing = 0xFFFFFFFFU;
  static constexpr std::uint8_t kGlass = 1;   ///< glass stands before it
  static constexpr std::uint8_t kSunlit = 2;  ///< it lies in World::sunlight
  std::vector<float> depth;                   ///< along the optical axis [m]; 0: nothing
  std::vector<std::uint8_t> flags;            ///< kGlass | kSunlit
  std::vector<std::uint32_t> triangle;        ///< counted through all models and parts; or kNothing
  std::vector<std::uint32_t> place;  ///< on it: barycentric u in the low, v in the high half
};

/// Casts one ray a pixel, through its centre, in packets of neighbouring pixels: 16, 8 or 4 at a
/// time, as many as the processor takes.
class CameraRays {
 public:
  /// @param sunlight boxes, world.
  CameraRays(const CameraModel& camera, std::vector<Eigen::AlignedBox3f> sunlight);

  /// @param triangles whether `triangle` and `place` are wanted; else they are left as they are.
  void cast(const WorldScene& scene, const Eigen::Isometry3d& T_world_optical, bool triangles,
            CameraHits& hits);
  /// Most rays of a packet: 4, 8 or 16; 0: the processor's choice.
  void limitPacket(int rays) { packet_ = rays; }

 private:
  /// Pixels from low (included) to high (excluded).
  struct PixelBox {
    int u_low, v_low, u_high, v_high;
  };
  template <int kRays>
  void castPackets(const WorldScene& scene, bool triangles, CameraHits& hits);
  void findBoxes(const WorldScene& scene);
  PixelBox pixelsOf(const Eigen::AlignedBox3f& bounds) const;
  static bool touches(const std::vector<PixelBox>& boxes, int u, int v, int columns, int rows);

  CameraModel camera_;
  std::vector<Eigen::AlignedBox3f> sunlight_;
  int packet_ = 0;
  std::vector<float> column_x_, row_y_;  ///< of the pixels, at depth 1
  Eigen::Matrix3f R_world_optical_ = Eigen::Matrix3f::Identity();
  Eigen::Vector3f eye_ = Eigen::Vector3f::Zero();
  std::vector<PixelBox> moving_, glass_, sunlit_;
  std::vector<std::uint32_t> first_triangle_;  ///< of each piece of the scene
};

}  // namespace pilothouse::sim
