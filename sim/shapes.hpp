#pragma once

#include "sim/world.hpp"

namespace pilothouse::sim {

// Meshes of simple shapes, in metres. Texture coordinates count metres along the surface.

/// Box about the origin.
Mesh boxMesh(const Eigen::Vector3d& size);
/// Cylinder about the z axis, from -length / 2 to length / 2.
Mesh cylinderMesh(double radius, double length, int corners = 24);
Mesh sphereMesh(double radius, int corners = 20);
/// Rectangle about the origin; size along the plane's own axes.
Mesh planeMesh(const Eigen::Vector3d& normal, const Eigen::Vector2d& size);
/// The mesh moved; the texture stays on it.
Mesh moved(Mesh mesh, const Eigen::Isometry3d& T_model_mesh);
/// Texture coordinates in repeats of `metres`.
void scaleTexture(Mesh& mesh, double metres);

/// A person 1.75 m tall who looks along x, about 0.5 m wide: legs, body, arms and head.
std::vector<Part> personParts(const Eigen::Vector3f& shirt, const Eigen::Vector3f& trousers);

}  // namespace pilothouse::sim
