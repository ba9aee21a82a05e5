#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "sim/world.hpp"

namespace pilothouse::sim {

/// Who looks, which decides what a ray stops at. Bits, to be combined.
enum RayKind : std::uint32_t {
  kCameraRay = 1,  ///< visible parts but glass
  kRangerRay = 2,  ///< visible parts, glass too
  kSolidRay = 4,   ///< what the robot touches or stands on, visible or not
  kGlassRay = 8,   ///< visible glass alone
};

/// The world's triangles ready for rays (Embree 3). Models stand where the world's file has them
/// until they are placed elsewhere. Copies what it needs of the world. One thread at a time.
class WorldScene {
 public:
  /// @throws std::runtime_error where Embree cannot be used.
  explicit WorldScene(const World& world);
  ~WorldScene();
  WorldScene(const WorldScene&) = delete;
  WorldScene& operator=(const WorldScene&) = delete;

  std::size_t modelCount() const;
  /// Moves a model; rays see it there after commit(). Contacts (forEachSolidTriangle) see it at
  /// once. The first move of a model costs a rebuild of the static scene, further ones next to
  /// nothing. @param model index into World::models. @throws std::out_of_range.
  void place(std::size_t model, const Eigen::Isometry3d& T_world_model);
  void commit();
  const Eigen::Isometry3d& pose(std::size_t model) const;

  struct Hit {
    float distance;          ///< along the ray, in lengths of `direction`
    std::uint32_t model;     ///< index into World::models
    std::uint32_t part;      ///< index into Model::parts
    Eigen::Vector3f normal;  ///< unit, world, towards where the ray came from
  };
  /// The nearest hit of one ray. @param direction need not be unit: distances are in its lengths.
  /// @param kinds of RayKind.
  std::optional<Hit> cast(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                          double farthest, std::uint32_t kinds) const;
  /// Height of the highest solid surface under the point, at or below from_z [m]; none: no ground.
  std::optional<double> groundBelow(const Eigen::Vector2d& point, double from_z) const;

  struct SolidTriangle {
    std::size_t model, part;
    std::array<Eigen::Vector3f, 3> corners;  ///< world [m]
  };
  /// Calls visit(const SolidTriangle&) for each triangle of a solid part whose bounds touch the box
  /// (world). Allocates nothing.
  template <class Visit>
  void forEachSolidTriangle(const Eigen::AlignedBox3f& box, Visit&& visit) const {
    for (const Piece& piece : pieces_) {
      if (!piece.solid || !piece.bounds.intersects(box)) continue;
      for (const auto& t : piece.triangles) {
        const SolidTriangle triangle{
            piece.model,
            piece.part,
            {piece.vertices[t[0]], piece.vertices[t[1]], piece.vertices[t[2]]}};
        Eigen::AlignedBox3f bounds(triangle.corners[0]);
        bounds.extend(triangle.corners[1]).extend(triangle.corners[2]);
        if (bounds.intersects(box)) visit(triangle);
      }
    }
  }

 private:
  friend class CameraRays;  // casts packets
  struct Embree;

  /// A part of a model. Its number is its index in pieces_, and its geometry's in Embree.
  struct Piece {
    std::size_t model, part;
    bool solid;
    std::uint32_t kinds;  ///< rays that stop at it
    std::vector<Eigen::Vector3f> in_model;
    std::vector<Eigen::Vector3f> vertices;  ///< world
    std::vector<std::array<std::uint32_t, 3>> triangles;
    Eigen::AlignedBox3f bounds;  ///< world
  };

  void toWorld(Piece& piece) const;
  int makeMover(std::size_t model);

  std::vector<Piece> pieces_;
  std::vector<std::size_t> first_piece_;  ///< of each model; one more at the end
  std::vector<Eigen::Isometry3d> poses_;
  std::unique_ptr<Embree> embree_;
};

}  // namespace pilothouse::sim
