#include "gui/view/place_layers.hpp"

#include <Eigen/Eigenvalues>
#include <QPainterPath>
#include <algorithm>
#include <cmath>

#include "gui/view/map_drive.hpp"
#include "gui/view/map_layers.hpp"
#include "gui/view/theme.hpp"

namespace pilothouse::gui {

namespace {

constexpr double kDegrees = 57.29577951308232;
constexpr double kLeastGhost = 26.0;  // pixels; a robot seen from afar stays visible

QPointF at(const MapView& view, Eigen::Vector2d place) {
  return view.toPixel(place.x(), place.y());
}

QPolygonF onMap(const MapView& view, const std::vector<Eigen::Vector2d>& points) {
  QPolygonF out;
  out.reserve(static_cast<int>(points.size()));
  for (const auto& p : points) {
    const QPointF pixel = at(view, p);
    // A planner's points lie closer than pixels when seen from afar.
    if (out.isEmpty() || std::hypot(pixel.x() - out.back().x(), pixel.y() - out.back().y()) > 1.5) {
      out << pixel;
    }
  }
  if (!points.empty()) out << at(view, points.back());
  return out;
}

void arrowHead(QPainter& painter, QPointF tip, double angle, double size) {
  painter.save();
  painter.translate(tip);
  painter.rotate(-angle * kDegrees);
  painter.drawPolygon(
      QPolygonF({{0, 0}, {-size, -size * 0.55}, {-size * 0.7, 0}, {-size, size * 0.55}}));
  painter.restore();
}

}  // namespace

QColor pathColour() {
  return {0x4c, 0xd0, 0x8f};
}
QColor trailColour() {
  return {0x7d, 0x9a, 0xc4};
}
QColor ghostColour() {
  return {0xff, 0xd1, 0x66};
}

void paintMap(QPainter& painter, const MapView& view, const MapPicture& map) {
  if (map.levels.empty()) return;
  const MapCells& cells = map.cells;
  const QRectF whole(view.toPixel(cells.origin_x, cells.origin_y + map.height()),
                     view.toPixel(cells.origin_x + map.width(), cells.origin_y));
  const QRectF seen = whole.intersected(QRectF(QPointF(0, 0), view.size()));
  if (seen.isEmpty()) return;
  // The coarsest picture whose pixels are no larger than the screen's.
  std::size_t level = 0;
  double pixels_a_cell = cells.cell_size * view.scale();
  while (level + 1 < map.levels.size() && pixels_a_cell <= 0.5) {
    ++level;
    pixels_a_cell *= 2.0;
  }
  const QImage& image = map.levels[level];
  // A pixel of a coarser level is always 2^level cells, also where the last one is only part full.
  const double to_image = 1.0 / pixels_a_cell;
  const QRectF source((seen.left() - whole.left()) * to_image,
                      (seen.top() - whole.top()) * to_image, seen.width() * to_image,
                      seen.height() * to_image);
  painter.setRenderHint(QPainter::SmoothPixmapTransform, false);
  painter.drawImage(seen, image, source);
  painter.setRenderHint(QPainter::Antialiasing, false);
  painter.setPen(QPen(theme::kLine, 1));
  painter.setBrush(Qt::NoBrush);
  painter.drawRect(whole);
}

void paintStanding(QPainter& painter, const MapView& view, const ObjectsPicture& objects) {
  painter.setRenderHint(QPainter::Antialiasing, false);
  painter.setPen(QPen(QColor(0x2f, 0x86, 0xff), 1));
  painter.setBrush(QColor(0x2f, 0x86, 0xff, 90));
  const QRectF screen(QPointF(0, 0), view.size());
  for (const auto& object : objects.objects) {
    const double side = std::max(3.0, double(object.size) * view.scale());
    const QPointF centre = view.toPixel(double(object.x), double(object.y));
    const QRectF box(centre.x() - side / 2, centre.y() - side / 2, side, side);
    if (screen.intersects(box)) painter.drawRect(box);
  }
}

void paintTrail(QPainter& painter, const MapView& view, const Trail& trail) {
  QPainterPath path;
  for (const auto& point : trail.points()) {
    const QPointF pixel = at(view, point.place);
    if (point.begins || path.elementCount() == 0) {
      path.moveTo(pixel);
    } else {
      path.lineTo(pixel);
    }
  }
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(trailColour(), 1.6, Qt::DotLine, Qt::RoundCap, Qt::RoundJoin));
  painter.drawPath(path);
}

void paintPath(QPainter& painter, const MapView& view, const std::vector<Eigen::Vector2d>& points,
               const QColor& colour, bool dashed) {
  if (points.size() < 2) return;
  const QPolygonF line = onMap(view, points);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(QColor(12, 14, 17, 190), 6, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  painter.drawPolyline(line);
  QPen pen(colour, 3, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin);
  if (dashed) pen.setDashPattern({3.0, 2.2});
  painter.setPen(pen);
  painter.drawPolyline(line);
  painter.setPen(QPen(QColor(12, 14, 17, 190), 1));
  painter.setBrush(colour);
  double since = 40.0;  // pixels between arrows: the first comes soon
  for (int i = 1; i < line.size(); ++i) {
    const QPointF step = line[i] - line[i - 1];
    since += std::hypot(step.x(), step.y());
    if (since < 90.0) continue;
    since = 0.0;
    arrowHead(painter, line[i], std::atan2(-step.y(), step.x()), 11.0);
  }
}

void paintSpread(QPainter& painter, const MapView& view, const Pose2& pose,
                 const Eigen::Matrix3d& covariance, const QColor& colour) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(covariance.topLeftCorner<2, 2>());
  const Eigen::Vector2d radii = 2.0 * axes.eigenvalues().cwiseMax(0.0).cwiseSqrt() * view.scale();
  const Eigen::Vector2d main = axes.eigenvectors().col(1);
  QColor fill = colour;
  fill.setAlpha(45);
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(colour, 1.2));
  painter.setBrush(fill);
  painter.translate(view.toPixel(pose.x, pose.y));
  painter.save();
  painter.rotate(-std::atan2(main.y(), main.x()) * kDegrees);
  painter.drawEllipse(QPointF(0, 0), radii.y(), radii.x());
  painter.restore();
  const double half = 2.0 * std::sqrt(std::max(0.0, covariance(2, 2)));
  const double reach = std::max(46.0, 0.8 * view.scale());
  const double wide = std::min(half, 3.14) * kDegrees;
  painter.drawPie(QRectF(-reach, -reach, 2 * reach, 2 * reach),
                  static_cast<int>(std::lround((pose.heading * kDegrees - wide) * 16)),
                  static_cast<int>(std::lround(2 * wide * 16)));
  painter.restore();
}

void paintGhost(QPainter& painter, const MapView& view, const Footprint& outline,
                Eigen::Vector2d place, std::optional<double> heading, const QColor& colour) {
  QColor fill = colour;
  fill.setAlpha(70);
  painter.setRenderHint(QPainter::Antialiasing);
  double reach = 0.05;
  for (const auto& corner : outline.corners()) reach = std::max(reach, corner.norm());
  if (!heading) {
    // Any heading: the circle that the robot sweeps by turning.
    const double radius = std::max(kLeastGhost / 2, reach * view.scale());
    painter.setPen(QPen(colour, 2, Qt::DashLine));
    painter.setBrush(fill);
    painter.drawEllipse(at(view, place), radius, radius);
    painter.setPen(QPen(colour, 2));
    painter.drawEllipse(at(view, place), 2.5, 2.5);
    return;
  }
  const double least = kLeastGhost / (2 * reach);
  inRobotFrame(painter, view, {place.x(), place.y(), *heading}, least, [&](const MapView& local) {
    painter.setPen(QPen(colour, 2, Qt::DashLine, Qt::RoundCap, Qt::RoundJoin));
    painter.setBrush(fill);
    painter.drawPolygon(onMap(local, outline.corners()));
    const double tip = std::max(reach * local.scale() * 0.9, 10.0);
    painter.setPen(QPen(colour, 2.5));
    painter.drawLine(QPointF(0, 0), QPointF(0, -tip - 14));
    painter.setPen(Qt::NoPen);
    painter.setBrush(colour);
    painter.drawPolygon(QPolygonF({{0, -tip - 22}, {-7, -tip - 8}, {0, -tip - 12}, {7, -tip - 8}}));
  });
}

void paintFlag(QPainter& painter, const MapView& view, Eigen::Vector2d place,
               std::optional<double> heading) {
  const QPointF foot = at(view, place);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(QColor(12, 14, 17, 220), 4));
  painter.drawLine(foot, foot + QPointF(0, -26));
  painter.setPen(QPen(Qt::white, 1.8));
  painter.drawLine(foot, foot + QPointF(0, -26));
  painter.setPen(QPen(QColor(12, 14, 17, 220), 1));
  painter.setBrush(pathColour());
  painter.drawPolygon(
      QPolygonF({foot + QPointF(1, -26), foot + QPointF(18, -20), foot + QPointF(1, -14)}));
  painter.setBrush(Qt::white);
  painter.drawEllipse(foot, 3.5, 3.5);
  if (heading) paintHeading(painter, view, place, *heading, pathColour());
}

void paintHeading(QPainter& painter, const MapView& view, Eigen::Vector2d place, double heading,
                  const QColor& colour) {
  const QPointF foot = at(view, place);
  const QPointF along(std::cos(heading), -std::sin(heading));
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(colour, 2.2));
  painter.drawLine(foot + along * 7, foot + along * 19);
  painter.setPen(Qt::NoPen);
  painter.setBrush(colour);
  arrowHead(painter, foot + along * 26, heading, 10);
}

void paintNearest(QPainter& painter, const MapView& view, Eigen::Vector2d wanted,
                  Eigen::Vector2d nearest) {
  const QPointF there = at(view, nearest);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(theme::kError, 1.6, Qt::DotLine));
  painter.drawLine(at(view, wanted), there);
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(QColor(12, 14, 17, 220), 6));
  painter.drawEllipse(there, 11, 11);
  painter.setPen(QPen(pathColour(), 3));
  painter.drawEllipse(there, 11, 11);
}

void paintCross(QPainter& painter, const MapView& view, Eigen::Vector2d place) {
  const QPointF c = at(view, place);
  painter.setRenderHint(QPainter::Antialiasing);
  for (const QPen& pen : {QPen(QColor(12, 14, 17, 220), 4), QPen(ghostColour(), 1.8)}) {
    painter.setPen(pen);
    for (const QPointF way : {QPointF(1, 0), QPointF(-1, 0), QPointF(0, 1), QPointF(0, -1)}) {
      painter.drawLine(c + way * 4, c + way * 14);
    }
  }
}

}  // namespace pilothouse::gui
