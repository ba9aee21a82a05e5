#include "doors/map_views.hpp"

#include <boost/make_shared.hpp>
#include <cmath>
#include <string>

namespace pilothouse {
namespace {

constexpr double kFarthest = 1e4;            // [m]
constexpr std::uint32_t kMostCells = 20000;  // a side

std::string faultOf(const MapGrid& grid) {
  const auto& info = grid.info;
  if (info.width > kMostCells || info.height > kMostCells) {
    return "map is " + std::to_string(info.width) + " x " + std::to_string(info.height) +
           " cells, expected at most " + std::to_string(kMostCells) + " a side";
  }
  if (!(info.resolution >= 0.001F && info.resolution <= 10.0F)) {
    return "resolution is " + std::to_string(info.resolution) + ", expected 0.001 to 10 m";
  }
  const auto& place = info.origin.position;
  const auto& turn = info.origin.orientation;
  if (!(std::abs(place.x) <= kFarthest && std::abs(place.y) <= kFarthest)) {
    return "origin is " + std::to_string(place.x) + " " + std::to_string(place.y) +
           ", expected within 10 km";
  }
  if (!(std::abs(turn.x) < 1e-6 && std::abs(turn.y) < 1e-6 && std::abs(turn.z) < 1e-6)) {
    return "origin is turned, expected no rotation";
  }
  const std::size_t cells = std::size_t{info.width} * info.height;
  if (grid.classes.size() != cells) {
    return "classes are " + std::to_string(grid.classes.size()) + ", expected " +
           std::to_string(cells);
  }
  return {};
}

}  // namespace

Checked<MapCells> openMap(const MapGrid& grid) {
  using Result = Checked<MapCells>;
  const std::string fault = faultOf(grid);
  if (!fault.empty()) return Result::refused(fault);
  MapCells map;
  map.origin_x = grid.info.origin.position.x;
  map.origin_y = grid.info.origin.position.y;
  // A double that went through a float: 0.05F is not 0.05, and over 2,000 cells it shows.
  map.cell_size = std::round(static_cast<double>(grid.info.resolution) * 1e7) / 1e7;
  map.size_x = static_cast<int>(grid.info.width);
  map.size_y = static_cast<int>(grid.info.height);
  map.cells.resize(grid.classes.size());
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    if (grid.classes[i] > static_cast<std::uint8_t>(MapCell::kDropOff)) {
      return Result::refused("a class is " + std::to_string(grid.classes[i]) + ", expected 0 to 4");
    }
    map.cells[i] = static_cast<MapCell>(grid.classes[i]);
  }
  return Result::of(std::move(map));
}

Checked<std::vector<Obstacle>> openObjects(const ObjectList& list) {
  using Result = Checked<std::vector<Obstacle>>;
  constexpr float kFarthestObject = 1e3F, kLargest = 10.0F;  // [m]
  std::vector<Obstacle> objects;
  objects.reserve(list.objects.size());
  for (const Object& object : list.objects) {
    const std::string name = "object " + std::to_string(objects.size());
    Obstacle obstacle;
    obstacle.position = {object.position.x, object.position.y};
    if (!(obstacle.position.norm() <= kFarthestObject)) {
      return Result::refused(name + " is at " + std::to_string(object.position.x) + " " +
                             std::to_string(object.position.y) + ", expected within 1 km");
    }
    if (!(object.size >= 0.0F && object.size <= kLargest)) {
      return Result::refused(name + " is of " + std::to_string(object.size) +
                             " m, expected 0 to 10");
    }
    if (object.kind < Object::THRESHOLD || object.kind > Object::DROP_OFF) {
      return Result::refused(name + " is of kind " + std::to_string(object.kind) +
                             ", expected 2 to 4");
    }
    const bool named = object.source < list.sources.size();
    const std::string& source = named ? list.sources[object.source].name : list.source;
    obstacle.height = object.position.z;
    obstacle.size = object.size;
    obstacle.kind = static_cast<CellClass>(object.kind);
    obstacle.source = source == "camera" ? 0 : 1;
    obstacle.remembered = object.remembered;
    objects.push_back(obstacle);
  }
  return Result::of(std::move(objects));
}

MapGrid::Ptr toMessage(const MapCells& map, const std::string& frame, const ros::Time& stamp,
                       std::uint32_t version) {
  auto message = boost::make_shared<MapGrid>();
  message->header.stamp = stamp;
  message->header.frame_id = frame;
  message->info.map_load_time = stamp;
  message->info.resolution = static_cast<float>(map.cell_size);
  message->info.width = static_cast<std::uint32_t>(map.size_x);
  message->info.height = static_cast<std::uint32_t>(map.size_y);
  message->info.origin.position.x = map.origin_x;
  message->info.origin.position.y = map.origin_y;
  message->info.origin.orientation.w = 1.0;
  message->version = version;
  message->classes.resize(map.cells.size());
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    message->classes[i] = static_cast<std::uint8_t>(map.cells[i]);
  }
  return message;
}

}  // namespace pilothouse
