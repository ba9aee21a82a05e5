#pragma once

#include <QColor>

#include "core/floor/floor_cells.hpp"
#include "core/mapping/map_cells.hpp"

namespace pilothouse::gui {

/// Colours of the cell classes on the dark map: after Okabe and Ito (2008), spread in lightness
/// too, so that they stay apart for every kind of colour blindness. Unknown is transparent.
QRgb classColour(CellClass cell_class);
/// Of an obstacle's cell below objects that carry a colour of their own.
constexpr QRgb kCalmObstacle = 0xff59636f;
/// In words, for legends and readouts.
const char* className(CellClass cell_class);

/// The same for a cell of the map: what is there for long is calmer than what is seen now.
QRgb mapCellColour(MapCell cell);
const char* mapCellName(MapCell cell);

}  // namespace pilothouse::gui
