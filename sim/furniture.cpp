#include "sim/furniture.hpp"

#include <cmath>

#include "sim/procedural_texture.hpp"
#include "sim/shapes.hpp"

namespace pilothouse::sim {

using Eigen::Vector3d;
using Eigen::Vector3f;

Part Finishes::part(const std::string& name, Mesh mesh, const Vector3d& place,
                    const Vector3f& colour, const std::string& texture) {
  Part part;
  part.name = name;
  part.mesh = moved(std::move(mesh), Eigen::Isometry3d(Eigen::Translation3d(place)));
  part.material.colour = colour;
  if (texture.empty()) return part;
  auto known = known_.find(texture);
  if (known == known_.end()) {
    const ProceduralTexture* made = proceduralTexture(texture);
    if (made == nullptr) return part;
    known = known_.emplace(texture, Known{static_cast<int>(textures_.size()), made->metres}).first;
    textures_.push_back(made->picture);
  }
  part.material.texture = known->second.index;
  scaleTexture(part.mesh, known->second.metres);
  return part;
}

Model modelAt(const std::string& name, const Pose2& pose) {
  Model model;
  model.name = name;
  model.T_world_model.translation() << pose.x, pose.y, 0.0;
  model.T_world_model.linear() =
      Eigen::AngleAxisd(pose.heading, Vector3d::UnitZ()).toRotationMatrix();
  return model;
}

void addBox(Model& model, Finishes& finishes, const Vector3d& size, const Vector3f& colour,
            const std::string& texture) {
  model.parts.push_back(
      finishes.part("box", boxMesh(size), {0.0, 0.0, size.z() / 2.0}, colour, texture));
}

void addCylinder(Model& model, Finishes& finishes, double radius, double height,
                 const Vector3f& colour) {
  model.parts.push_back(
      finishes.part("cylinder", cylinderMesh(radius, height), {0.0, 0.0, height / 2.0}, colour));
}

void addTable(Model& model, Finishes& finishes, const Vector3d& size) {
  constexpr double kTop = 0.035, kLeg = 0.05;
  const Vector3f oak(0.72F, 0.55F, 0.38F);
  model.parts.push_back(finishes.part("top", boxMesh({size.x(), size.y(), kTop}),
                                      {0.0, 0.0, size.z() - kTop / 2.0}, Vector3f::Ones(),
                                      "board"));
  const double leg = size.z() - kTop;
  for (const double x : {-0.5, 0.5}) {
    for (const double y : {-0.5, 0.5}) {
      model.parts.push_back(finishes.part(
          "leg", boxMesh({kLeg, kLeg, leg}),
          {x * (size.x() - 2.0 * kLeg), y * (size.y() - 2.0 * kLeg), leg / 2.0}, oak));
    }
  }
}

void addChair(Model& model, Finishes& finishes, const Vector3f& colour) {
  const Vector3f wood(0.55F, 0.40F, 0.27F);
  model.parts.push_back(
      finishes.part("seat", boxMesh({0.42, 0.42, 0.05}), {0.0, 0.0, 0.45}, colour, "fabric"));
  model.parts.push_back(
      finishes.part("back", boxMesh({0.04, 0.40, 0.42}), {-0.19, 0.0, 0.70}, colour, "fabric"));
  for (const double x : {-0.18, 0.18})
    for (const double y : {-0.18, 0.18})
      model.parts.push_back(finishes.part("leg", boxMesh({0.04, 0.04, 0.43}), {x, y, 0.215}, wood));
}

void addHump(Model& model, Finishes& finishes, double run, double height, double level,
             double width) {
  const double end = run + level / 2.0;
  const double slope = std::hypot(run, height), tilt = std::atan2(height, run);
  constexpr double kThick = 0.03;
  // Slabs whose upper faces are the hump; what lies below them nobody sees.
  for (const double side : {-1.0, 1.0}) {
    Eigen::Isometry3d pose(Eigen::Translation3d(side * (end - run / 2.0), 0.0, height / 2.0));
    pose.rotate(Eigen::AngleAxisd(side * tilt, Vector3d::UnitY()));
    pose.translate(Vector3d(0.0, 0.0, -kThick / 2.0));
    Part part = finishes.part("slope", moved(boxMesh({slope, width, kThick}), pose),
                              Vector3d::Zero(), Vector3f::Ones(), "board");
    model.parts.push_back(std::move(part));
  }
  model.parts.push_back(finishes.part("level", boxMesh({level, width, height}),
                                      {0.0, 0.0, height / 2.0}, Vector3f::Ones(), "board"));
}

}  // namespace pilothouse::sim
