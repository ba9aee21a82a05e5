#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/cloud/checked.hpp"
#include "sim/world.hpp"

namespace pilothouse::sim {

/// What libsdformat does not tell of a world's file: our own elements, and what is not simulated.
struct WorldNotes {
  Pose2 start;
  std::map<std::string, std::vector<Eigen::Vector2d>> routes;
  std::vector<Eigen::AlignedBox3d> sunlight;
  std::map<std::string, double> courtesy;  ///< by actor's name [m]
  std::vector<std::string> warnings;       ///< each with its line
};

/// Checks the XML of a world before libsdformat reads it, which loses the line of many faults: well
/// formed, one world, known shapes, every number finite and within its range, names unique.
/// Refused with line and element.
Checked<WorldNotes> readWorldXml(const std::string& text);

}  // namespace pilothouse::sim
