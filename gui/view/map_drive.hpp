#pragma once

#include <QPainter>
#include <optional>
#include <string>
#include <vector>

#include "core/motion/footprint.hpp"
#include "gui/model/drive_readings.hpp"
#include "gui/model/map_view.hpp"
#include "gui/model/pictures.hpp"

namespace pilothouse::gui {

/// A ranger with what it measures.
struct RangerMark {
  double x, y, yaw;      ///< base frame [m, rad]
  double field_of_view;  ///< [rad]
  double max;            ///< [m]
  double range;          ///< [m]; infinite: nothing; NaN: silent
};

/// Heights of objects to be picked out [m].
struct HeightBand {
  double low, high;
};

/// What of driving the map shows.
struct DriveOverlay {
  std::vector<RangerMark> rangers;
  std::optional<Twist2> wish;  ///< what is wanted now
  LimitReading limit;          ///< with its cause at a place, when it limits
  bool limits = false;
  double look_ahead = 2.0;  ///< [m]
};

QColor inTheWayColour(InTheWay relevance);
QColor atHeightColour();

/// By whether they are in the way: a cross, a stroke or nothing beside the colour; hollow where
/// only remembered; a diamond at the height in question. @param least_side of a mark [pixels].
void paintJudgedObjects(QPainter& painter, const MapView& view, const ObjectsPicture& objects,
                        const std::optional<HeightBand>& band, double least_side = 5.0);
/// One object's mark, also for the legend.
void paintObjectMark(QPainter& painter, const QRectF& box, const ObjectMark& object,
                     bool at_height);
void paintRangers(QPainter& painter, const MapView& view, const std::vector<RangerMark>& rangers);
/// Where the robot is about to go, and where what limits it stands.
void paintWay(QPainter& painter, const MapView& view, const Footprint& footprint,
              const DriveOverlay& drive);
void paintCause(QPainter& painter, const MapView& view, const DriveOverlay& drive);

}  // namespace pilothouse::gui
