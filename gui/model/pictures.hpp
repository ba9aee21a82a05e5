#pragma once

#include <QImage>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/cloud/depth_view.hpp"
#include "core/floor/floor_cells.hpp"
#include "gui/model/depth_ramp.hpp"

namespace pilothouse::gui {

/// A depth picture ready to be drawn.
struct DepthPicture {
  QImage image;               ///< RGB32, false colour
  std::vector<float> metres;  ///< row by row; 0: no measurement
  DepthSpan span;             ///< metres at the two ends of the colours
  std::string frame;
  std::optional<Intrinsics> intrinsics;  ///< absent without camera_info; estimated from clouds

  /// Metres at a pixel; 0 outside and where nothing was measured.
  float at(int column, int row) const {
    if (column < 0 || row < 0 || column >= image.width() || row >= image.height()) return 0.0F;
    return metres[static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width()) +
                  static_cast<std::size_t>(column)];
  }
};

struct ColourPicture {
  QImage image;  ///< RGB32
  std::string frame;
};

/// The floor grid with a picture of it: forward is up, so pixel (column, row) is the cell
/// (size_x - 1 - row, size_y - 1 - column).
struct FloorPicture {
  GridGeometry geometry;
  std::vector<CellClass> classes;
  std::vector<float> heights;     ///< [m], NaN where unknown
  std::vector<float> deviations;  ///< [m], NaN where unknown
  std::string frame, method;
  QImage image;  ///< ARGB32, transparent where unknown
  QImage calm;   ///< the same with obstacles in grey: below objects that tell whether they matter
};

/// Whether an object is in the way, in the order of Object.relevance.
enum class InTheWay : std::uint8_t { kOther, kPotential, kYes };

struct ObjectMark {
  float x, y, size;  ///< centre and edge, base frame [m]
  CellClass kind;
  bool nearest_in_row;
  InTheWay relevance = InTheWay::kOther;
  float z = std::numeric_limits<float>::quiet_NaN();  ///< mean height [m]; NaN: not measured
  bool remembered = false;
};

struct ObjectsPicture {
  std::vector<ObjectMark> objects;
  std::string frame;
};

}  // namespace pilothouse::gui
