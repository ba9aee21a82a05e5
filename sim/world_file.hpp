#pragma once

#include <string>
#include <vector>

#include "core/cloud/checked.hpp"
#include "sim/world.hpp"

namespace pilothouse::sim {

struct LoadedWorld {
  World world;
  std::vector<std::string> warnings;  ///< what the file says that is not simulated, with its line
};

/// Reads a world from an SDF file (docs in maps/README.md). Refused with file, line and element:
/// whatever is not understood, not finite, out of range or too large.
Checked<LoadedWorld> loadWorld(const std::string& path);

}  // namespace pilothouse::sim
