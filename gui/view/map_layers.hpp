#pragma once

#include <QPainter>

#include "doors/robot_description.hpp"
#include "gui/model/map_view.hpp"
#include "gui/model/pictures.hpp"

namespace pilothouse::gui {

// The layers of the map, from below. Each draws in the widget's pixels.

QColor robotColour();

/// Grid lines at a round distance.
void paintGrid(QPainter& painter, const MapView& view, QSizeF size);
/// Rings of range about the robot, with metres.
void paintRings(QPainter& painter, const MapView& view, QSizeF size);
/// @param calm obstacles in grey, below objects with colours of their own. @param rim an outline
/// tells how far the robot looks.
void paintFloor(QPainter& painter, const MapView& view, const FloorPicture& floor,
                bool calm = false, bool rim = true);
/// The nearest of their row outlined in white, the others plain.
void paintObjects(QPainter& painter, const MapView& view, const ObjectsPicture& objects);
void paintRobot(QPainter& painter, const MapView& view, const RobotDescription& robot);
void paintScaleBar(QPainter& painter, const MapView& view, QPointF right_bottom);
/// The mark of a drop-off's cell, beside its colour.
void hatch(QPainter& painter, const QRectF& box);
/// Swatches in as many rows as needed, in map_legend.cpp.
struct LegendOf {
  bool judged, heights, rangers;  ///< what the map shows beside the floor
};
void paintLegend(QPainter& painter, QPointF left_bottom, double most_width, LegendOf of);

}  // namespace pilothouse::gui
