#pragma once

#include <string>
#include <vector>

#include "sim/world.hpp"

namespace pilothouse::sim {

/// A texture that is computed, so that worlds look like something without files beside them.
struct ProceduralTexture {
  Texture picture;
  double metres;  ///< that the picture covers
};
/// By name, as in <pilothouse:texture>wood</pilothouse:texture>; nullptr: no such name. Computed
/// once a process.
const ProceduralTexture* proceduralTexture(const std::string& name);
std::vector<std::string> proceduralTextureNames();

}  // namespace pilothouse::sim
