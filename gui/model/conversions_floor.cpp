#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "gui/model/class_colours.hpp"
#include "gui/model/conversions.hpp"

namespace pilothouse::gui {

namespace {

constexpr std::uint32_t kMaxSide = 4096;
constexpr std::size_t kMaxObjects = 200000;
constexpr std::size_t kMostDrawnObjects = 5000;

template <class T>
std::string lengthFault(const char* name, const std::vector<T>& array, std::size_t expected) {
  if (array.size() == expected) return {};
  return std::string(name) + " has " + std::to_string(array.size()) + " entries, expected " +
         std::to_string(expected);
}

std::string faultOf(const FloorGrid& grid) {
  const auto& info = grid.info;
  if (info.width == 0 || info.height == 0 || info.width > kMaxSide || info.height > kMaxSide) {
    return "grid of " + std::to_string(info.width) + " x " + std::to_string(info.height) +
           " cells, expected 1 to " + std::to_string(kMaxSide) + " a side";
  }
  const float resolution = info.resolution;
  if (!(resolution >= 0.001F && resolution <= 10.0F)) {
    return "cells of " + std::to_string(resolution) + " m, expected 0.001 to 10 m";
  }
  const auto& origin = info.origin.position;
  if (!(std::abs(origin.x) < 1e4 && std::abs(origin.y) < 1e4)) {
    return "origin is not a place within 10 km";
  }
  const auto& turn = info.origin.orientation;
  if (!(std::abs(turn.x) < 1e-6 && std::abs(turn.y) < 1e-6 && std::abs(turn.z) < 1e-6)) {
    return "origin is turned, expected no rotation";
  }
  const std::size_t cells = std::size_t{info.width} * info.height;
  std::string fault = lengthFault("classes", grid.classes, cells);
  if (fault.empty()) fault = lengthFault("heights", grid.heights, cells);
  if (fault.empty()) fault = lengthFault("deviations", grid.deviations, cells);
  if (!fault.empty()) return fault;
  for (const std::uint8_t c : grid.classes) {
    if (c > static_cast<std::uint8_t>(CellClass::kDropOff)) {
      return "class " + std::to_string(c) + ", expected 0 to 4";
    }
  }
  return {};
}

}  // namespace

Converted<FloorPicture> floorFromMessage(const FloorGrid& grid) {
  using Result = Converted<FloorPicture>;
  const std::string fault = faultOf(grid);
  if (!fault.empty()) return Result::refused(fault);
  auto picture = std::make_shared<FloorPicture>();
  GridGeometry& geometry = picture->geometry;
  geometry.x_min = static_cast<float>(grid.info.origin.position.x);
  geometry.y_min = static_cast<float>(grid.info.origin.position.y);
  geometry.cell_size = grid.info.resolution;
  geometry.size_x = static_cast<int>(grid.info.width);
  geometry.size_y = static_cast<int>(grid.info.height);
  picture->classes.reserve(grid.classes.size());
  for (const std::uint8_t c : grid.classes) picture->classes.push_back(static_cast<CellClass>(c));
  picture->heights = grid.heights;
  picture->deviations = grid.deviations;
  picture->frame = grid.header.frame_id;
  picture->method = grid.method.substr(0, 32);
  picture->image = QImage(geometry.size_y, geometry.size_x, QImage::Format_ARGB32);
  picture->calm = picture->image;
  for (int row = 0; row < geometry.size_x; ++row) {
    auto* line = reinterpret_cast<QRgb*>(picture->image.scanLine(row));
    auto* calm = reinterpret_cast<QRgb*>(picture->calm.scanLine(row));
    for (int column = 0; column < geometry.size_y; ++column) {
      const CellClass cell =
          picture->classes[geometry.index(geometry.size_x - 1 - row, geometry.size_y - 1 - column)];
      line[column] = classColour(cell);
      calm[column] = cell == CellClass::kObstacle ? kCalmObstacle : classColour(cell);
    }
  }
  return Result::of(std::move(picture));
}

namespace {

// The gravest of each cell of a grid, which is as coarse as it takes to keep no more than can be
// drawn many times a second; each then stands for its cell.
void thin(std::vector<ObjectMark>& marks) {
  const auto grave = [](const ObjectMark& mark) {
    return std::make_pair(mark.relevance, mark.kind);
  };
  for (float cell = 0.02F; marks.size() > kMostDrawnObjects; cell *= 2.0F) {
    std::unordered_map<std::uint64_t, std::size_t> places;
    std::vector<ObjectMark> kept;
    for (const auto& mark : marks) {
      const auto column = static_cast<std::int32_t>(std::floor(mark.x / cell));
      const auto row = static_cast<std::int32_t>(std::floor(mark.y / cell));
      const std::uint64_t place = static_cast<std::uint64_t>(static_cast<std::uint32_t>(column))
                                      << 32 |
                                  static_cast<std::uint32_t>(row);
      const auto [known, first] = places.emplace(place, kept.size());
      if (first) {
        kept.push_back(mark);
      } else if (grave(mark) > grave(kept[known->second])) {
        kept[known->second] = mark;
      }
      auto& stands = kept[known->second];
      stands.size = std::max(stands.size, cell);
    }
    marks = std::move(kept);
  }
}

}  // namespace

Converted<ObjectsPicture> objectsFromMessage(const ObjectList& list) {
  using Result = Converted<ObjectsPicture>;
  if (list.objects.size() > kMaxObjects) {
    return Result::refused(std::to_string(list.objects.size()) + " objects, expected at most " +
                           std::to_string(kMaxObjects));
  }
  auto picture = std::make_shared<ObjectsPicture>();
  picture->frame = list.header.frame_id;
  picture->objects.reserve(list.objects.size());
  for (const auto& object : list.objects) {
    const auto& p = object.position;
    if (!(std::abs(p.x) < 1e4F && std::abs(p.y) < 1e4F && object.size > 0.0F &&
          object.size < 100.0F)) {
      return Result::refused("an object without a finite place and size");
    }
    if (object.kind < Object::THRESHOLD || object.kind > Object::DROP_OFF) {
      return Result::refused("object of kind " + std::to_string(object.kind) + ", expected 2 to 4");
    }
    if (object.relevance > Object::IN_THE_WAY) {
      return Result::refused("object of relevance " + std::to_string(object.relevance) +
                             ", expected 0 to 2");
    }
    picture->objects.push_back({p.x, p.y, object.size, static_cast<CellClass>(object.kind),
                                object.nearest_in_row != 0, static_cast<InTheWay>(object.relevance),
                                std::abs(p.z) < 1e3F ? p.z : NAN, object.remembered != 0});
  }
  thin(picture->objects);
  return Result::of(std::move(picture));
}

}  // namespace pilothouse::gui
