#pragma once

#include <QPainter>
#include <optional>
#include <vector>

#include "core/motion/footprint.hpp"
#include "doors/robot_description.hpp"
#include "gui/model/map_view.hpp"
#include "gui/model/pictures.hpp"
#include "gui/model/place_readings.hpp"
#include "gui/model/trail.hpp"

namespace pilothouse::gui {

// The layers of the map that stays in place, from below. Each draws in the widget's pixels; the
// view is one of the map's frame.

/// The cells that are in sight, from the picture that fits the scale.
void paintMap(QPainter& painter, const MapView& view, const MapPicture& map);
/// What stays, in the map's frame.
void paintStanding(QPainter& painter, const MapView& view, const ObjectsPicture& objects);
void paintTrail(QPainter& painter, const MapView& view, const Trail& trail);
/// A way with its width on the floor, and arrows along it.
void paintPath(QPainter& painter, const MapView& view, const std::vector<Eigen::Vector2d>& points,
               const QColor& colour, bool dashed);
/// Two standard deviations of the place, and of the heading as a wedge.
void paintSpread(QPainter& painter, const MapView& view, const Pose2& pose,
                 const Eigen::Matrix3d& covariance, const QColor& colour);
/// The robot's outline at a pose, hollow, with an arrow where it has a heading.
void paintGhost(QPainter& painter, const MapView& view, const Footprint& outline,
                Eigen::Vector2d place, std::optional<double> heading, const QColor& colour);
/// Where the robot drives to.
void paintFlag(QPainter& painter, const MapView& view, Eigen::Vector2d place,
               std::optional<double> heading);
/// An arrow from the place along its heading.
void paintHeading(QPainter& painter, const MapView& view, Eigen::Vector2d place, double heading,
                  const QColor& colour);
/// The nearest place that can be reached, instead of one that cannot.
void paintNearest(QPainter& painter, const MapView& view, Eigen::Vector2d wanted,
                  Eigen::Vector2d nearest);
/// The cross that arrow keys move.
void paintCross(QPainter& painter, const MapView& view, Eigen::Vector2d place);
/// Colours of ways, of the trail and of the ghost, for the legend too.
QColor pathColour();
QColor trailColour();
QColor ghostColour();

/// Draws with `paint` what lies in the robot's frame: it gets a view about the robot.
/// @param least_scale of that view [pixels a metre]; 0: the map's.
template <class Paint>
void inRobotFrame(QPainter& painter, const MapView& view, const Pose2& pose, double least_scale,
                  Paint&& paint) {
  constexpr double kDegrees = 57.29577951308232;
  painter.save();
  painter.translate(view.toPixel(pose.x, pose.y));
  painter.rotate(90.0 - pose.heading * kDegrees);  // forward of the robot's view is up
  const double scale = view.scale() < least_scale ? least_scale : view.scale();
  paint(MapView::about(MapView::Axes::kForwardUp, scale));
  painter.restore();
}

}  // namespace pilothouse::gui
