#pragma once

#include <cstdint>
#include <vector>

#include "sim/camera_rays.hpp"
#include "sim/texture_levels.hpp"
#include "sim/world.hpp"
#include "sim/world_scene.hpp"

namespace pilothouse::sim {

/// Colours of a world's triangles under light from above and from a side.
class WorldLook {
 public:
  explicit WorldLook(const World& world);

  /// RGB of each pixel. @param focal_length [pixel], for how coarse a texture may be.
  void paint(const WorldScene& scene, const CameraHits& hits, float focal_length,
             std::uint8_t* rgb);

 private:
  /// A triangle's corners: light on each, and texture coordinates as first and two edges.
  struct Triangle {
    float colour[4];  ///< RGB, 0..255; with a texture 0..1
    float light[3];   ///< at the first corner, and how much more at the others
    std::int32_t texture;
    float s[3], t[3];
    float density;  ///< texture repeats a metre
  };
  struct Lit {
    std::vector<Eigen::Vector3f> normals;  ///< of each corner, model's frame
    std::size_t first;                     ///< triangle
    Eigen::Matrix3f R_world_model;         ///< for which it is lit
  };
  static void light(const Lit& model, std::vector<Triangle>& triangles);

  std::vector<Triangle> triangles_;
  std::vector<Lit> models_;
  std::vector<TextureLevels> textures_;
};

}  // namespace pilothouse::sim
