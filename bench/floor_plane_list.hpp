#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/cloud/checked.hpp"

namespace pilothouse::bench {

/// A floor plane measured before, in the camera's optical frame.
struct KnownPlane {
  std::string file;        ///< as the list names it
  Eigen::Vector3d normal;  ///< unit, up
  double height = 0.0;     ///< of the camera above the floor [m]
  double tilt = 0.0;       ///< atan2(-normal.z, -normal.y), positive looks down [deg]
};

/// Reads lines "FILE n=(X Y Z) h=H tilt=T ..."; '#' starts a comment. Refused: no such line, or one
/// that says something else, named by its number.
Checked<std::vector<KnownPlane>> readKnownPlanes(const std::string& path);

}  // namespace pilothouse::bench
