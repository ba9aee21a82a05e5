#pragma once

#include <embree3/rtcore.h>

#include <vector>

#include "sim/world_scene.hpp"

namespace pilothouse::sim {

/// Embree's side of the scene: what never moved in one scene, each model that did as an instance in
/// another, so that a move rebuilds nothing but the few boxes round those.
struct WorldScene::Embree {
  struct Mover {
    std::size_t model;
    RTCScene scene;        ///< the model alone, in its own frame
    RTCGeometry instance;  ///< its number in `moving` is its index in movers
  };
  RTCDevice device = nullptr;
  RTCScene fixed = nullptr;
  RTCScene moving = nullptr;
  std::vector<Mover> movers;
  std::vector<int> mover_of;   ///< of each model; -1: fixed
  std::vector<bool> in_fixed;  ///< of each piece
  bool fixed_changed = true;
  bool moving_changed = true;

  Embree();
  ~Embree();
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;

  /// Adds a piece's triangles to a scene under the piece's number. False: no ray sees the piece.
  bool attach(RTCScene scene, const Piece& piece, unsigned int number,
              const std::vector<Eigen::Vector3f>& vertices);
  void place(const Mover& mover, const Eigen::Isometry3d& T_world_model);
};

}  // namespace pilothouse::sim
