// A mesh that is let through has triangles whose corners exist and lie within bounds; what is
// refused has a reason. The first byte of the input chooses OBJ or STL.
#include <cmath>

#include "sim/mesh_file.hpp"
#include "test/fuzz/input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pilothouse;
  FuzzInput input(data, size);
  const bool obj = (input.take<std::uint8_t>() & 1U) == 0;
  const auto bytes = input.rest();
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), input.left());
  const auto mesh = obj ? sim::parseObj(text) : sim::parseStl(text);
  if (!mesh) return require(!mesh.reason().empty()), 0;
  require(!mesh->triangles.empty() && mesh->triangles.size() <= sim::kMostMeshTriangles);
  for (const auto& triangle : mesh->triangles)
    for (const std::uint32_t corner : triangle) require(corner < mesh->vertices.size());
  for (const auto& vertex : mesh->vertices)
    require(vertex.cwiseAbs().maxCoeff() <= static_cast<float>(sim::kFarthestVertex));
  require(mesh->texture_coordinates.empty() ||
          mesh->texture_coordinates.size() == mesh->vertices.size());
  return 0;
}
