#include "sim/world_materials.hpp"

#include <png.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sdf/Material.hh>
#include <sdf/Pbr.hh>
#include <sdf/Visual.hh>

#include "core/cloud/quoted.hpp"
#include "core/replay/png_header.hpp"
#include "sim/procedural_texture.hpp"
#include "sim/world_limits.hpp"

namespace pilothouse::sim {
namespace {

constexpr const char* kTextureElement = "pilothouse:texture";

}  // namespace

Checked<std::string> readFile(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0)
    return Checked<std::string>::refused(std::strerror(errno));
  if (!S_ISREG(status.st_mode)) return Checked<std::string>::refused("not a file");
  if (static_cast<std::uint64_t>(status.st_size) > kMostFileBytes)
    return Checked<std::string>::refused("larger than 64 MB");
  std::ifstream file(path, std::ios::binary);
  std::string bytes(static_cast<std::size_t>(status.st_size), '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!file) return Checked<std::string>::refused("cannot be read");
  return Checked<std::string>::of(std::move(bytes));
}

Checked<std::string> fileOf(const std::string& uri, const std::string& folder) {
  std::string name = uri;
  if (name.compare(0, 7, "file://") == 0) name.erase(0, 7);
  if (name.find("://") != std::string::npos)
    return Checked<std::string>::refused("only files beside the world are read");
  if (name.empty() || name[0] == '/' || ("/" + name + "/").find("/../") != std::string::npos)
    return Checked<std::string>::refused("expected a file in the world's folder or below it");
  return Checked<std::string>::of(folder + "/" + name);
}

Checked<Texture> readPng(const std::string& path) {
  const auto bytes = readFile(path);
  if (!bytes) return Checked<Texture>::refused(bytes.reason());
  const PngBounds bounds{4096, std::uint64_t{1} << 22U};
  const auto header =
      parsePngHeader(reinterpret_cast<const std::uint8_t*>(bytes->data()), bytes->size(), bounds);
  if (!header) return Checked<Texture>::refused(header.reason());
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&image, bytes->data(), bytes->size()) == 0)
    return Checked<Texture>::refused(image.message);
  image.format = PNG_FORMAT_RGB;
  Texture texture{image.width, image.height, {}};
  texture.rgb.resize(PNG_IMAGE_SIZE(image));
  const png_color white{255, 255, 255};
  if (png_image_finish_read(&image, &white, texture.rgb.data(), 0, nullptr) == 0)
    return Checked<Texture>::refused(image.message);
  return Checked<Texture>::of(std::move(texture));
}

Checked<WorldMaterials::Read> WorldMaterials::read(const sdf::Visual& visual) {
  Read read;
  read.material.glass = visual.Transparency() >= 0.5F;
  const sdf::Material* material = visual.Material();
  if (material == nullptr) return Checked<Read>::of(read);
  // SDF's own default is white where a colour is not said.
  const bool coloured = material->Element() && material->Element()->HasElement("diffuse");
  const auto diffuse = material->Diffuse();
  if (coloured) read.material.colour = {diffuse.R(), diffuse.G(), diffuse.B()};
  std::string picture;
  if (const sdf::Pbr* pbr = material->PbrMaterial()) {
    for (const auto type : {sdf::PbrWorkflowType::METAL, sdf::PbrWorkflowType::SPECULAR})
      if (const auto* workflow = pbr->Workflow(type)) picture = workflow->AlbedoMap();
  }
  std::string texture;
  if (material->Element() && material->Element()->HasElement(kTextureElement))
    texture = material->Element()->Get<std::string>(kTextureElement);
  if (!picture.empty() || !texture.empty()) {
    if (!coloured) read.material.colour = {1.0F, 1.0F, 1.0F};
    return picture.empty() ? readTexture(texture, read) : readPicture(picture, read);
  }
  return Checked<Read>::of(read);
}

Checked<WorldMaterials::Read> WorldMaterials::readTexture(const std::string& name, Read read) {
  auto known = known_.find(name);
  if (known == known_.end()) {
    const ProceduralTexture* texture = proceduralTexture(name);
    if (texture == nullptr)
      return Checked<Read>::refused("texture " + pilothouse::quoted(name) + " is not known");
    Read added;
    added.material.texture = static_cast<int>(textures_.size());
    added.texture_metres = texture->metres;
    textures_.push_back(texture->picture);
    known = known_.emplace(name, added).first;
  }
  read.material.texture = known->second.material.texture;
  read.texture_metres = known->second.texture_metres;
  return Checked<Read>::of(read);
}

Checked<WorldMaterials::Read> WorldMaterials::readPicture(const std::string& uri, Read read) {
  const std::string key = "file " + uri;
  auto known = known_.find(key);
  if (known == known_.end()) {
    if (textures_.size() >= kMostTextures)
      return Checked<Read>::refused("more than " + std::to_string(kMostTextures) + " textures");
    const auto path = fileOf(uri, folder_);
    if (!path)
      return Checked<Read>::refused("picture " + pilothouse::quoted(uri) + ": " + path.reason());
    const auto picture = readPng(*path);
    if (!picture)
      return Checked<Read>::refused("picture " + pilothouse::quoted(uri) + ": " + picture.reason());
    Read added;
    added.material.texture = static_cast<int>(textures_.size());
    textures_.push_back(*picture);
    known = known_.emplace(key, added).first;
  }
  read.material.texture = known->second.material.texture;
  return Checked<Read>::of(read);
}

}  // namespace pilothouse::sim
