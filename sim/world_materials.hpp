#pragma once

#include <map>
#include <sdf/Visual.hh>
#include <string>
#include <vector>

#include "core/cloud/checked.hpp"
#include "sim/world.hpp"

namespace pilothouse::sim {

/// Bytes of a regular file of at most kMostFileBytes.
Checked<std::string> readFile(const std::string& path);
/// The file that a URI of a world's file names: relative to the folder, which it may not leave.
Checked<std::string> fileOf(const std::string& uri, const std::string& folder);
/// A PNG file's picture.
Checked<Texture> readPng(const std::string& path);

/// Reads what things look like, each texture once.
class WorldMaterials {
 public:
  explicit WorldMaterials(std::string folder) : folder_(std::move(folder)) {}

  struct Read {
    Material material;
    double texture_metres = 1.0;  ///< that one repeat of the texture covers
  };
  Checked<Read> read(const sdf::Visual& visual);
  std::vector<Texture> takeTextures() { return std::move(textures_); }

 private:
  Checked<Read> readTexture(const std::string& name, Read read);
  Checked<Read> readPicture(const std::string& uri, Read read);

  std::string folder_;
  std::vector<Texture> textures_;
  std::map<std::string, Read> known_;
};

}  // namespace pilothouse::sim
