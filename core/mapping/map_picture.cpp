#include "core/mapping/map_picture.hpp"

#include <cmath>
#include <sstream>

#include "core/cloud/quoted.hpp"

namespace pilothouse {
namespace {

constexpr std::uint32_t kMostPixels = 20000;  // a side
constexpr double kFarthest = 1e4;             // [m]

bool isSpace(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f';
}

/// Next number of a header, after white space and comments; false where there is none.
bool takeNumber(std::string_view bytes, std::size_t& at, std::uint32_t& number) {
  const std::size_t begin = at;
  while (at < bytes.size() && (isSpace(bytes[at]) || bytes[at] == '#')) {
    if (bytes[at] == '#') {
      while (at < bytes.size() && bytes[at] != '\n') ++at;
    } else {
      ++at;
    }
  }
  const std::size_t digits = at;
  number = 0;
  for (; at < bytes.size() && bytes[at] >= '0' && bytes[at] <= '9'; ++at) {
    if (at - digits >= 9) return false;
    number = number * 10 + static_cast<std::uint32_t>(bytes[at] - '0');
  }
  return at > digits && digits > begin;
}

template <class Value>
std::string wrong(const char* thing, const Value& value, const std::string& expected) {
  std::ostringstream text;
  text << thing << " is " << value << ", expected " << expected;
  return text.str();
}

std::string faultOf(const PictureMeaning& m) {
  if (!(m.resolution >= 0.01 && m.resolution <= 0.5)) {
    return wrong("resolution", m.resolution, "0.01 to 0.5 m");
  }
  for (const double origin : {m.origin_x, m.origin_y}) {
    if (!(std::abs(origin) <= kFarthest)) return wrong("origin", origin, "within 10 km");
  }
  if (!(m.occupied_thresh >= 0.0 && m.occupied_thresh <= 1.0)) {
    return wrong("occupied_thresh", m.occupied_thresh, "0 to 1");
  }
  if (!(m.free_thresh >= 0.0 && m.free_thresh <= m.occupied_thresh)) {
    return wrong("free_thresh", m.free_thresh, "0 to occupied_thresh");
  }
  return {};
}

}  // namespace

Checked<GreyPicture> parsePgm(std::string_view bytes) {
  using Result = Checked<GreyPicture>;
  if (bytes.substr(0, 2) != "P5") {
    return Result::refused(wrong("the beginning", quoted(bytes.substr(0, 2)), "that of a PGM, P5"));
  }
  GreyPicture picture;
  std::size_t at = 2;
  if (!takeNumber(bytes, at, picture.width) || !takeNumber(bytes, at, picture.height) ||
      !takeNumber(bytes, at, picture.white)) {
    return Result::refused("the PGM's header ends at byte " + std::to_string(at) +
                           ", expected width, height and greatest value");
  }
  if (picture.width == 0 || picture.height == 0 || picture.width > kMostPixels ||
      picture.height > kMostPixels) {
    return Result::refused("the picture is " + std::to_string(picture.width) + " x " +
                           std::to_string(picture.height) + " pixels, expected 1 to " +
                           std::to_string(kMostPixels) + " a side");
  }
  if (picture.white == 0 || picture.white > 255) {
    return Result::refused(wrong("the greatest value", picture.white, "1 to 255"));
  }
  const std::uint64_t pixels = std::uint64_t{picture.width} * picture.height;
  if (at >= bytes.size() || !isSpace(bytes[at]) || bytes.size() - at - 1 != pixels) {
    const std::size_t there = at < bytes.size() ? bytes.size() - at - 1 : 0;
    return Result::refused("the picture holds " + std::to_string(there) + " pixels, expected " +
                           std::to_string(picture.width) + " x " + std::to_string(picture.height) +
                           " = " + std::to_string(pixels));
  }
  picture.pixels = reinterpret_cast<const std::uint8_t*>(bytes.data() + at + 1);
  return Result::of(picture);
}

Checked<std::shared_ptr<OccupancyMap>> mapOf(const GreyPicture& picture,
                                             const PictureMeaning& meaning,
                                             const OccupancyParameters& parameters) {
  using Result = Checked<std::shared_ptr<OccupancyMap>>;
  const std::string fault = faultOf(meaning);
  if (!fault.empty()) return Result::refused(fault);
  OccupancyParameters own = parameters;
  own.cell_size = meaning.resolution;
  const auto faults = validate(own);
  if (!faults.empty()) return Result::refused(faults.front());
  const auto map = std::make_shared<OccupancyMap>(own);
  const CellPlace corner = map->cellOf(meaning.origin_x + 1e-9, meaning.origin_y + 1e-9);
  map->setAnchor(
      {meaning.origin_x - corner.ix * own.cell_size, meaning.origin_y - corner.iy * own.cell_size});
  std::vector<CellPlace> free, occupied;  // of a row: the picture may be large
  for (std::uint32_t v = 0; v < picture.height; ++v) {
    free.clear();
    occupied.clear();
    for (std::uint32_t u = 0; u < picture.width; ++u) {
      const double light =
          static_cast<double>(picture.pixels[std::size_t{v} * picture.width + u]) / picture.white;
      const double darkness = meaning.negate ? light : 1.0 - light;
      const CellPlace place{corner.ix + static_cast<std::int32_t>(u),
                            corner.iy + static_cast<std::int32_t>(picture.height - 1 - v)};
      if (darkness > meaning.occupied_thresh) occupied.push_back(place);
      if (darkness < meaning.free_thresh) free.push_back(place);
    }
    map->set(free, MapCell::kFree);
    map->set(occupied, MapCell::kOccupied);
    if (map->refusedCells() > 0) {
      return Result::refused(
          wrong("known cells of a row outside of the map's square", map->refusedCells(),
                "none beyond " + std::to_string(0.5 * own.max_side) + " m from the map's origin"));
    }
  }
  return Result::of(map);
}

std::string encodePgm(const MapCells& map) {
  std::string bytes =
      "P5\n" + std::to_string(map.size_x) + " " + std::to_string(map.size_y) + "\n255\n";
  bytes.reserve(bytes.size() + map.cells.size());
  for (int iy = map.size_y - 1; iy >= 0; --iy) {
    for (int ix = 0; ix < map.size_x; ++ix) {
      const MapCell cell = map.at(ix, iy);
      const bool blocked = cell == MapCell::kOccupied || cell == MapCell::kDropOff;
      bytes += static_cast<char>(blocked ? 0 : cell == MapCell::kUnknown ? 205 : 254);
    }
  }
  return bytes;
}

}  // namespace pilothouse
