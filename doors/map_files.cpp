#include "doors/map_files.hpp"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <regex>
#include <stdexcept>
#include <system_error>

#include "core/cloud/quoted.hpp"
#include "core/mapping/checksum.hpp"
#include "core/mapping/map_bytes.hpp"
#include "core/mapping/map_picture.hpp"
#include "doors/atomic_file.hpp"
#include "doors/file_bytes.hpp"
#include "doors/strict_parameters.hpp"
#include "doors/yaml_values.hpp"

namespace pilothouse {
namespace {

namespace fs = std::filesystem;
using Loaded = Checked<std::shared_ptr<OccupancyMap>>;

constexpr std::size_t kMostBytes = std::size_t{1} << 30;
constexpr std::size_t kLongestName = 64;

bool isNameLetter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '-';
}

/// The shortest text that reads as the number again.
std::string asText(double number) {
  char text[40];
  for (int digits = 6; digits <= 17; ++digits) {
    std::snprintf(text, sizeof text, "%.*g", digits, number);
    if (std::strtod(text, nullptr) == number) break;
  }
  return text;
}

std::string yamlOf(const MapFiles& files, const std::string& image) {
  return "image: " + image + "\nresolution: " + asText(files.resolution) + "\norigin: [" +
         asText(files.origin_x) + ", " + asText(files.origin_y) +
         ", 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
}

/// Pictures of the name that no YAML refers to any more.
void removeOldPictures(const fs::path& folder, const std::string& name, const std::string& newest) {
  const std::regex ours(name + "\\.[0-9a-f]{8}\\.pgm");
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string file = entry->path().filename().string();
    std::error_code ignored;  // an old picture that stays harms nothing
    if (file != newest && std::regex_match(file, ours)) fs::remove(entry->path(), ignored);
  }
}

/// What the YAML says, strictly read. @throws ParameterFault
PictureMeaning readMeaning(StrictParameters& reader, std::string& image) {
  PictureMeaning meaning;
  int negate = 0;
  std::string mode = "trinary";
  reader.quiet();
  reader.require({"image", "resolution", "origin"});
  reader.read("image", image);
  reader.read("resolution", meaning.resolution, 0.01, 0.5);
  reader.read("negate", negate, 0, 1);
  reader.read("occupied_thresh", meaning.occupied_thresh, 0.0, 1.0);
  reader.read("free_thresh", meaning.free_thresh, 0.0, 1.0);
  reader.read("mode", mode, {"trinary"});
  meaning.negate = negate != 0;
  XmlRpc::XmlRpcValue origin = reader.raw("origin");
  double numbers[3] = {0.0, 0.0, 0.0};
  bool sound = origin.getType() == XmlRpc::XmlRpcValue::TypeArray && origin.size() == 3;
  for (int i = 0; sound && i < 3; ++i) {
    const bool whole = origin[i].getType() == XmlRpc::XmlRpcValue::TypeInt;
    sound = whole || origin[i].getType() == XmlRpc::XmlRpcValue::TypeDouble;
    if (sound) numbers[i] = whole ? int(origin[i]) : double(origin[i]);
  }
  if (origin.valid() && !(sound && numbers[2] == 0.0)) {
    reader.addWrong("origin", origin, "[x, y, 0]: two numbers [m] and no rotation");
  }
  reader.finish();
  meaning.origin_x = numbers[0];
  meaning.origin_y = numbers[1];
  return meaning;
}

Loaded loadOwn(const std::string& path, const OccupancyParameters& parameters) {
  try {
    const auto map = decodeMap(readWhole(path, kMostBytes), parameters);
    return map ? map : Loaded::refused(path + ": " + map.reason());
  } catch (const std::runtime_error& fault) {
    return Loaded::refused(path + ": " + fault.what());
  }
}

}  // namespace

std::string mapNameFault(const std::string& name) {
  bool sound = !name.empty() && name.size() <= kLongestName;
  for (const char c : name) sound = sound && isNameLetter(c);
  if (sound) return {};
  return "name is " + pilothouse::quoted(name) + ", expected 1 to 64 letters, digits, _ and -";
}

MapFiles filesOf(const OccupancyMap& map) {
  MapCells cells;
  map.snapshot(cells);
  if (cells.cells.empty()) {  // a picture has at least a pixel
    cells.size_x = cells.size_y = 1;
    cells.cells.assign(1, MapCell::kUnknown);
  }
  return {encodeMap(map), encodePgm(cells), cells.cell_size, cells.origin_x, cells.origin_y};
}

void saveMap(const std::string& folder, const std::string& name, const MapFiles& files) {
  const std::string fault = mapNameFault(name);
  if (!fault.empty()) throw std::runtime_error(fault);
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw std::runtime_error("cannot make " + folder + ": " + error.message());
  const fs::path base = fs::path(folder) / name;
  writeAtomically(base.string() + ".phmap", files.own);
  // The picture is named after what it shows: the YAML's replacement brings both at once.
  char sum[16];
  std::snprintf(sum, sizeof sum, ".%08x.pgm", crc32(files.picture));
  writeAtomically(base.string() + sum, files.picture);
  writeAtomically(base.string() + ".yaml", yamlOf(files, name + sum));
  removeOldPictures(folder, name, name + sum);
}

Loaded loadMapServer(const std::string& yaml_path, const OccupancyParameters& parameters) {
  const auto values = readYaml(yaml_path);
  if (!values) return Loaded::refused(values.reason());
  if (values->getType() != XmlRpc::XmlRpcValue::TypeStruct) {
    return Loaded::refused(yaml_path + ": not a map's YAML: expected image, resolution, origin");
  }
  std::string image;
  PictureMeaning meaning;
  try {
    StrictParameters reader(yaml_path, *values);
    XmlRpc::XmlRpcValue all = *values;
    for (const auto& entry : all) reader.accept(entry.first);  // others' keys harm nobody
    meaning = readMeaning(reader, image);
  } catch (const ParameterFault& fault) {
    return Loaded::refused(fault.faults().front());
  }
  // map_saver -f writes a folder too, as it was named then: the picture lies beside the YAML.
  const std::string beside = fs::path(image).filename().string();
  const std::string path = (fs::path(yaml_path).parent_path() / beside).string();
  std::error_code error;
  if (beside.empty() || (beside != image && !fs::is_regular_file(path, error))) {
    return Loaded::refused(yaml_path + ": image is " + pilothouse::quoted(image) +
                           ", expected the name of a PGM in the same folder");
  }
  try {
    const std::string bytes = readWhole(path, kMostBytes);
    const auto picture = parsePgm(bytes);
    if (!picture) return Loaded::refused(path + ": " + picture.reason());
    const auto map = mapOf(*picture, meaning, parameters);
    return map ? map : Loaded::refused(yaml_path + ": " + map.reason());
  } catch (const std::runtime_error& fault) {
    return Loaded::refused(path + ": " + fault.what());
  }
}

Loaded loadMap(const std::string& folder, const std::string& name,
               const OccupancyParameters& parameters) {
  const std::string fault = mapNameFault(name);
  if (!fault.empty()) return Loaded::refused(fault);
  const std::string base = (fs::path(folder) / name).string();
  std::error_code error;
  if (fs::exists(base + ".phmap", error)) return loadOwn(base + ".phmap", parameters);
  if (fs::exists(base + ".yaml", error)) return loadMapServer(base + ".yaml", parameters);
  return Loaded::refused(base + ": no such map, expected " + name + ".phmap or " + name + ".yaml");
}

}  // namespace pilothouse
