#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/motion/planar.hpp"

namespace pilothouse::sim {

/// Triangles, counter-clockwise seen from outside.
struct Mesh {
  std::vector<Eigen::Vector3f> vertices;                ///< model's frame [m]
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< into vertices
  std::vector<Eigen::Vector2f> texture_coordinates;     ///< one a vertex, or none
};

/// A picture, RGB, row by row from the top.
struct Texture {
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

struct Material {
  Eigen::Vector3f colour{0.7F, 0.7F, 0.7F};  ///< RGB, 0..1
  int texture = -1;                          ///< index into World::textures; -1: none
  bool glass = false;  ///< a depth camera's light goes through it; contacts and rangers do not
};

/// A piece of one model with one look.
struct Part {
  std::string name;
  Mesh mesh;
  Material material;
  bool visible = true;  ///< to cameras and rangers
  bool solid = true;    ///< the robot can touch or stand on it
};

/// Where an actor is when; straight and at even speed between the points.
struct ActorPath {
  struct Point {
    double time;  ///< [s], rising
    Pose2 pose;   ///< world
  };
  std::vector<Point> points;  ///< at least one
  bool loop = true;           ///< starts over after the last point; else stays there
};

struct Model {
  std::string name;  ///< unique in its world
  Eigen::Isometry3d T_world_model = Eigen::Isometry3d::Identity();
  std::vector<Part> parts;
  std::optional<ActorPath> path;  ///< an actor: its x, y and heading follow this
  /// Somebody who halts while the robot is within this distance ahead of them [m]; 0: walks on
  /// whatever happens.
  double courtesy = 0.0;
};

struct World {
  std::string name;
  std::vector<Model> models;  ///< the floor is a model too
  std::vector<Texture> textures;
  Pose2 start;                                                 ///< of the robot
  std::map<std::string, std::vector<Eigen::Vector2d>> routes;  ///< by name, world [m]
  /// Sunlit boxes: a structured-light camera measures nothing there.
  std::vector<Eigen::AlignedBox3d> sunlight;
};

}  // namespace pilothouse::sim
