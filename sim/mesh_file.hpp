#pragma once

#include <string_view>

#include "core/cloud/checked.hpp"
#include "sim/world.hpp"

namespace pilothouse::sim {

constexpr std::size_t kMostMeshTriangles = 100000;
constexpr double kFarthestVertex = 10000.0;  ///< [m]

/// Wavefront OBJ: v, vt and f; everything else is passed over. Faces of more than three corners
/// become fans. The reason for refusing names the line.
Checked<Mesh> parseObj(std::string_view text);
/// STL, binary or ASCII. No texture coordinates.
Checked<Mesh> parseStl(std::string_view bytes);

}  // namespace pilothouse::sim
