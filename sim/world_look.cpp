#include "sim/world_look.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace pilothouse::sim {
namespace {

constexpr float kSmoothed = 0.7F;  // cosine up to which neighbouring triangles look round
constexpr std::size_t kMostAround = 64;
constexpr float kSunshine = 1.35F;
constexpr float kPlaceUnit = 1.0F / 65535.0F;

// Four floats at a time, of which three are used: every processor we know does that at once.
using Pixel = float __attribute__((vector_size(16)));
using Whole = std::int32_t __attribute__((vector_size(16)));
constexpr Pixel kSky = {203.0F, 216.0F, 228.0F, 0.0F};
constexpr Pixel kGlass = {196.0F, 224.0F, 228.0F, 0.0F};
constexpr float kGlassShare = 0.22F;

inline Pixel fromBytes(std::uint32_t texel) {
  const auto channel = [&](unsigned int shift) {
    return static_cast<std::int32_t>((texel >> shift) & 255U);
  };
  return __builtin_convertvector((Whole{channel(0), channel(8), channel(16), 0}), Pixel);
}

inline void store(Pixel pixel, std::uint8_t* rgb) {
  const Pixel most = {255.0F, 255.0F, 255.0F, 255.0F};
  const Whole bytes = __builtin_convertvector(pixel < most ? pixel : most, Whole);
  rgb[0] = static_cast<std::uint8_t>(bytes[0]);
  rgb[1] = static_cast<std::uint8_t>(bytes[1]);
  rgb[2] = static_cast<std::uint8_t>(bytes[2]);
}

float brightness(const Eigen::Vector3f& normal) {
  static const Eigen::Vector3f lamp = Eigen::Vector3f(0.35F, -0.55F, 0.75F).normalized();
  return 0.72F + 0.08F * normal.z() + 0.06F * normal.x() + 0.22F * std::max(0.0F, normal.dot(lamp));
}

std::vector<Eigen::Vector3f> cornerNormals(const Mesh& mesh) {
  std::vector<Eigen::Vector3f> flat;
  std::vector<std::vector<std::uint32_t>> around(mesh.vertices.size());
  for (const auto& t : mesh.triangles) {
    for (const std::uint32_t vertex : t)
      around[vertex].push_back(static_cast<std::uint32_t>(flat.size()));
    const Eigen::Vector3f a = mesh.vertices[t[0]];
    flat.push_back((mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a));
  }
  std::vector<Eigen::Vector3f> normals;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (const std::uint32_t vertex : mesh.triangles[i]) {
      Eigen::Vector3f sum = flat[i];
      if (around[vertex].size() > kMostAround) around[vertex].clear();  // a hub, not a bend
      for (const std::uint32_t other : around[vertex])
        if (other != i && flat[other].normalized().dot(flat[i].normalized()) > kSmoothed)
          sum += flat[other];
      normals.push_back(sum.squaredNorm() > 0.0F ? sum.normalized() : Eigen::Vector3f::UnitZ());
    }
  }
  return normals;
}

}  // namespace

WorldLook::WorldLook(const World& world) {
  for (const Texture& texture : world.textures) textures_.emplace_back(texture);
  for (const Model& model : world.models) {
    Lit lit{{}, triangles_.size(), model.T_world_model.linear().cast<float>()};
    for (const Part& part : model.parts) {
      const Mesh& mesh = part.mesh;
      const auto normals = cornerNormals(mesh);
      lit.normals.insert(lit.normals.end(), normals.begin(), normals.end());
      const bool textured = part.material.texture >= 0 && !mesh.texture_coordinates.empty();
      for (const auto& corners : mesh.triangles) {
        Triangle triangle{};
        triangle.texture = textured ? part.material.texture : -1;
        for (int c = 0; c < 3; ++c)
          triangle.colour[c] = part.material.colour[c] * (textured ? 1.0F : 255.0F);
        if (textured) {
          const Eigen::Vector2f first = mesh.texture_coordinates[corners[0]];
          const Eigen::Vector2f second = mesh.texture_coordinates[corners[1]] - first;
          const Eigen::Vector2f third = mesh.texture_coordinates[corners[2]] - first;
          for (int axis = 0; axis < 2; ++axis) {
            float* const coordinate = axis == 0 ? triangle.s : triangle.t;
            coordinate[0] = first[axis];
            coordinate[1] = second[axis];
            coordinate[2] = third[axis];
          }
          const Eigen::Vector3f a = mesh.vertices[corners[0]];
          const float area =
              (mesh.vertices[corners[1]] - a).cross(mesh.vertices[corners[2]] - a).norm();
          const float texture_area = std::abs(second.x() * third.y() - second.y() * third.x());
          triangle.density = std::sqrt(texture_area / std::max(area, 1e-9F));
        }
        triangles_.push_back(triangle);
      }
    }
    light(lit, triangles_);
    models_.push_back(std::move(lit));
  }
}

void WorldLook::light(const Lit& model, std::vector<Triangle>& triangles) {
  for (std::size_t i = 0; i < model.normals.size() / 3; ++i) {
    Triangle& triangle = triangles[model.first + i];
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Eigen::Vector3f normal = model.R_world_model * model.normals[3 * i + corner];
      triangle.light[corner] = brightness(normal);
      if (corner > 0) triangle.light[corner] -= triangle.light[0];
    }
  }
}

void WorldLook::paint(const WorldScene& scene, const CameraHits& hits, float focal_length,
                      std::uint8_t* rgb) {
  const float metres_a_pixel = 1.0F / focal_length;
  for (std::size_t m = 0; m < models_.size(); ++m) {
    const Eigen::Matrix3f R_world_model = scene.pose(m).linear().cast<float>();
    if (R_world_model == models_[m].R_world_model) continue;
    models_[m].R_world_model = R_world_model;
    light(models_[m], triangles_);
  }
  for (std::size_t i = 0; i < hits.triangle.size(); ++i, rgb += 3) {
    Pixel pixel = kSky;
    const std::uint8_t flags = hits.flags[i];
    if (hits.triangle[i] != CameraHits::kNothing) {
      const Triangle& triangle = triangles_[hits.triangle[i]];
      const float u = static_cast<float>(static_cast<int>(hits.place[i] & 0xFFFFU)) * kPlaceUnit;
      const float v = static_cast<float>(static_cast<int>(hits.place[i] >> 16U)) * kPlaceUnit;
      float light = triangle.light[0] + u * triangle.light[1] + v * triangle.light[2];
      if (flags & CameraHits::kSunlit) light *= kSunshine;
      std::memcpy(&pixel, triangle.colour, sizeof pixel);
      pixel *= light;
      if (triangle.texture >= 0) {
        const float s = triangle.s[0] + u * triangle.s[1] + v * triangle.s[2];
        const float t = triangle.t[0] + u * triangle.t[1] + v * triangle.t[2];
        const std::uint32_t texel = textures_[static_cast<std::size_t>(triangle.texture)].sample(
            s, t, triangle.density * hits.depth[i] * metres_a_pixel);
        pixel *= fromBytes(texel);
      }
    }
    if (flags & CameraHits::kGlass) pixel += kGlassShare * (kGlass - pixel);
    store(pixel, rgb);
  }
}

}  // namespace pilothouse::sim
