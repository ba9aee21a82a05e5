#pragma once

#include <string>

#include "sim/world.hpp"

namespace pilothouse::sim {

/// Looks that furniture is made of, as textures of one world.
class Finishes {
 public:
  /// @param textures of the world; those asked for are added to it.
  explicit Finishes(std::vector<Texture>& textures) : textures_(textures) {}
  /// A visible, solid part. @param texture name of a procedural texture, or empty.
  Part part(const std::string& name, Mesh mesh, const Eigen::Vector3d& place,
            const Eigen::Vector3f& colour, const std::string& texture = "");

 private:
  struct Known {
    int index;
    double metres;
  };
  std::vector<Texture>& textures_;
  std::map<std::string, Known> known_;
};

/// A model that stands on the floor at z = 0.
Model modelAt(const std::string& name, const Pose2& pose);
void addBox(Model& model, Finishes& finishes, const Eigen::Vector3d& size,
            const Eigen::Vector3f& colour, const std::string& texture = "");
void addCylinder(Model& model, Finishes& finishes, double radius, double height,
                 const Eigen::Vector3f& colour);
/// With four legs. @param size of the top and its upper edge's height.
void addTable(Model& model, Finishes& finishes, const Eigen::Vector3d& size);
/// 0.46 m square.
void addChair(Model& model, Finishes& finishes, const Eigen::Vector3f& colour);
/// A hump across y that rises along x over `run` to `height`, is level for `level`, and falls
/// again.
void addHump(Model& model, Finishes& finishes, double run, double height, double level,
             double width);

}  // namespace pilothouse::sim
