#include <algorithm>
#include <new>

#include "gui/model/class_colours.hpp"
#include "gui/model/conversions_place.hpp"

namespace pilothouse::gui {

namespace {

constexpr int kSmallestLevel = 64;  // pixels a side; below that a picture saves nothing

// A coarser picture shows of its cells what may not be missed: the classes lie in that order.
static_assert(MapCell::kUnknown < MapCell::kFree && MapCell::kFree < MapCell::kThreshold &&
              MapCell::kThreshold < MapCell::kOccupied && MapCell::kOccupied < MapCell::kDropOff);

using Row = std::vector<unsigned char>;

struct Plane {
  int width = 0, height = 0;
  Row gravest;  ///< north up
};

Plane finest(const MapCells& cells) {
  Plane plane{cells.size_x, cells.size_y, Row(cells.cells.size())};
  const auto width = static_cast<std::size_t>(cells.size_x);
  for (int row = 0; row < cells.size_y; ++row) {
    const std::size_t from = cells.index(0, cells.size_y - 1 - row);
    const std::size_t to = static_cast<std::size_t>(row) * width;
    for (std::size_t i = 0; i < width; ++i) {
      plane.gravest[to + i] = static_cast<unsigned char>(cells.cells[from + i]);
    }
  }
  return plane;
}

Plane halved(const Plane& fine) {
  Plane coarse{(fine.width + 1) / 2, (fine.height + 1) / 2, {}};
  coarse.gravest.resize(static_cast<std::size_t>(coarse.width) *
                        static_cast<std::size_t>(coarse.height));
  for (int row = 0; row < coarse.height; ++row) {
    const auto stride = static_cast<std::size_t>(fine.width);
    const unsigned char* upper = fine.gravest.data() + static_cast<std::size_t>(2 * row) * stride;
    const unsigned char* lower = 2 * row + 1 < fine.height ? upper + stride : upper;
    unsigned char* to = coarse.gravest.data() +
                        static_cast<std::size_t>(row) * static_cast<std::size_t>(coarse.width);
    for (int column = 0; column < coarse.width; ++column) {
      const int left = 2 * column, right = std::min(left + 1, fine.width - 1);
      to[column] =
          std::max(std::max(upper[left], upper[right]), std::max(lower[left], lower[right]));
    }
  }
  return coarse;
}

QImage painted(const Plane& plane) {
  QRgb colours[5];
  for (std::size_t i = 0; i < 5; ++i)
    colours[i] = qPremultiply(mapCellColour(static_cast<MapCell>(i)));
  QImage image(plane.width, plane.height, QImage::Format_ARGB32_Premultiplied);
  if (image.isNull()) throw std::bad_alloc();
  const unsigned char* from = plane.gravest.data();
  for (int row = 0; row < plane.height; ++row) {
    auto* line = reinterpret_cast<QRgb*>(image.scanLine(row));
    for (int column = 0; column < plane.width; ++column) line[column] = colours[*from++];
  }
  return image;
}

}  // namespace

std::vector<QImage> mapLevels(const MapCells& cells) {
  std::vector<QImage> levels;
  if (cells.cells.empty()) return levels;
  Plane plane = finest(cells);
  levels.push_back(painted(plane));
  while (std::max(plane.width, plane.height) > 2 * kSmallestLevel) {
    plane = halved(plane);
    levels.push_back(painted(plane));
  }
  return levels;
}

}  // namespace pilothouse::gui
