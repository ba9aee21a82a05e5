#include "gui/model/class_colours.hpp"

namespace pilothouse::gui {

QRgb classColour(CellClass cell_class) {
  switch (cell_class) {
    case CellClass::kFloor:
      return qRgb(0x2b, 0x5c, 0x7a);
    case CellClass::kThreshold:
      return qRgb(0xf0, 0xe4, 0x42);
    case CellClass::kObstacle:
      return qRgb(0xe0, 0x62, 0x14);
    case CellClass::kDropOff:
      return qRgb(0xc3, 0x8f, 0xf0);
    case CellClass::kUnknown:
      break;
  }
  return qRgba(0, 0, 0, 0);
}

const char* className(CellClass cell_class) {
  switch (cell_class) {
    case CellClass::kFloor:
      return "floor";
    case CellClass::kThreshold:
      return "threshold";
    case CellClass::kObstacle:
      return "obstacle";
    case CellClass::kDropOff:
      return "drop-off";
    case CellClass::kUnknown:
      break;
  }
  return "unknown";
}

}  // namespace pilothouse::gui
