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

QRgb mapCellColour(MapCell cell) {
  switch (cell) {
    case MapCell::kFree:
      return qRgb(0x2a, 0x3d, 0x4c);
    case MapCell::kThreshold:
      return qRgb(0xc9, 0xbf, 0x3a);
    case MapCell::kOccupied:
      return qRgb(0xc8, 0xd2, 0xdc);
    case MapCell::kDropOff:
      return qRgb(0xb0, 0x76, 0xe6);
    case MapCell::kUnknown:
      break;
  }
  return qRgba(0, 0, 0, 0);
}

const char* mapCellName(MapCell cell) {
  switch (cell) {
    case MapCell::kFree:
      return "free";
    case MapCell::kThreshold:
      return "threshold";
    case MapCell::kOccupied:
      return "occupied";
    case MapCell::kDropOff:
      return "drop-off";
    case MapCell::kUnknown:
      break;
  }
  return "unknown";
}

}  // namespace pilothouse::gui
