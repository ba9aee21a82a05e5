#include "gui/view/map_layers.hpp"

#include <QPainterPath>
#include <algorithm>
#include <cmath>

#include "gui/model/class_colours.hpp"
#include "gui/view/theme.hpp"

namespace pilothouse::gui {

namespace {

const QColor kGridLine(0x29, 0x30, 0x39);
const QColor kRing(0x55, 0x62, 0x72);

QString metresText(double metres, double step) {
  return QString::number(metres, 'f', step < 0.095 ? 2 : step < 0.95 ? 1 : 0);
}

}  // namespace

void hatch(QPainter& painter, const QRectF& box) {
  painter.setPen(QPen(QColor(60, 20, 90, 200), 1));
  painter.drawLine(box.bottomLeft(), box.topRight());
}

QColor robotColour() {
  return {0xf4, 0xf7, 0xfa};
}

void paintGrid(QPainter& painter, const MapView& view, QSizeF size) {
  const double step = roundLength(70.0, view.scale());
  const QRectF seen =
      QRectF(view.toMetres({0, 0}), view.toMetres({size.width(), size.height()})).normalized();
  const auto line = [&](QPointF from, QPointF to) {
    const auto on = [&](QPointF metres) {
      const QPointF pixel = view.toPixel(metres.x(), metres.y());
      return QPointF(std::round(pixel.x()), std::round(pixel.y()));
    };
    painter.drawLine(on(from), on(to));
  };
  painter.setRenderHint(QPainter::Antialiasing, false);
  painter.setPen(QPen(kGridLine, 1));
  for (double x = std::ceil(seen.left() / step) * step; x < seen.right(); x += step) {
    line({x, seen.top()}, {x, seen.bottom()});
  }
  for (double y = std::ceil(seen.top() / step) * step; y < seen.bottom(); y += step) {
    line({seen.left(), y}, {seen.right(), y});
  }
}

void paintRings(QPainter& painter, const MapView& view, QSizeF size) {
  const double step = std::max(0.5, roundLength(90.0, view.scale()));
  const QPointF centre = view.toPixel(0, 0);
  const double farthest = std::hypot(std::max(centre.x(), size.width() - centre.x()),
                                     std::max(centre.y(), size.height() - centre.y()));
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setFont(theme::smallFont());
  painter.setBrush(Qt::NoBrush);
  QPen pen(kRing, 1);
  pen.setDashPattern({3, 5});
  for (double r = step; r * view.scale() < farthest && r < 40 * step; r += step) {
    painter.setPen(pen);
    painter.drawEllipse(centre, r * view.scale(), r * view.scale());
  }
  for (double r = step; r * view.scale() < farthest && r < 40 * step; r += step) {
    const QPointF at = view.toPixel(r, 0);
    const QString text = metresText(r, step) + " m";
    const QRectF box(at.x() + 3, at.y() - 17, painter.fontMetrics().horizontalAdvance(text) + 6,
                     16);
    painter.fillRect(box, QColor(18, 21, 25, 150));
    painter.setPen(theme::kText);
    painter.drawText(box, Qt::AlignCenter, text);
  }
}

void paintFloor(QPainter& painter, const MapView& view, const FloorPicture& floor, bool calm,
                bool rim) {
  const GridGeometry& g = floor.geometry;
  const double x_max = double(g.x_min) + double(g.cell_size) * g.size_x;
  const double y_max = double(g.y_min) + double(g.cell_size) * g.size_y;
  const QRectF where(view.toPixel(x_max, y_max), view.toPixel(double(g.x_min), double(g.y_min)));
  painter.setRenderHint(QPainter::SmoothPixmapTransform, false);
  painter.drawImage(where, calm && !floor.calm.isNull() ? floor.calm : floor.image);
  painter.setRenderHint(QPainter::Antialiasing, false);
  painter.setPen(QPen(theme::kLine, 1));
  painter.setBrush(Qt::NoBrush);
  if (rim) painter.drawRect(where);
  // Drop-offs carry a hatch as well as a colour: mistaking one is the costliest error on the map.
  const double side = double(g.cell_size) * view.scale();
  if (side < 4.0) return;
  for (int ix = 0; ix < g.size_x; ++ix) {
    for (int iy = 0; iy < g.size_y; ++iy) {
      if (floor.classes[g.index(ix, iy)] != CellClass::kDropOff) continue;
      const QPointF centre = view.toPixel(double(g.centreX(ix)), double(g.centreY(iy)));
      hatch(painter, QRectF(centre.x() - side / 2, centre.y() - side / 2, side, side));
    }
  }
}

void paintObjects(QPainter& painter, const MapView& view, const ObjectsPicture& objects) {
  painter.setRenderHint(QPainter::Antialiasing);
  QVector<QRectF> nearest;
  QVector<QColor> colours;
  for (const auto& object : objects.objects) {
    const double side = std::max(4.0, double(object.size) * view.scale());
    const QPointF centre = view.toPixel(double(object.x), double(object.y));
    const QRectF box(centre.x() - side / 2, centre.y() - side / 2, side, side);
    if (!object.nearest_in_row) {
      painter.fillRect(box, QColor(classColour(object.kind)));
      if (object.kind == CellClass::kDropOff) hatch(painter, box);
      continue;
    }
    nearest << box;
    colours << QColor(classColour(object.kind));
  }
  for (int i = 0; i < nearest.size(); ++i) {
    painter.setPen(QPen(Qt::white, 1.4));
    painter.setBrush(colours[i]);
    painter.drawRect(nearest[i].adjusted(0.7, 0.7, -0.7, -0.7));
  }
}

void paintRobot(QPainter& painter, const MapView& view, const RobotDescription& robot) {
  QPolygonF outline;
  double front = 0.0;
  for (const auto& point : robot.footprint) {
    outline << view.toPixel(point[0], point[1]);
    front = std::max(front, point[0]);
  }
  painter.setRenderHint(QPainter::Antialiasing);
  // A dark rim keeps it apart from any cell, a bright one from the dark.
  painter.setPen(QPen(QColor(0x12, 0x15, 0x19), 5, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  painter.drawPolygon(outline);
  painter.setPen(QPen(theme::kAccent, 2, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  painter.setBrush(robotColour());
  painter.drawPolygon(outline);
  // Heading: an arrow head inside the front.
  const double size = std::clamp(front * view.scale() * 0.42, 4.0, 40.0);
  const QPointF tip = view.toPixel(front * 0.86, 0);
  QPainterPath arrow(tip);
  arrow.lineTo(tip + QPointF(size * 0.75, size * 1.1));
  arrow.lineTo(tip + QPointF(0, size * 0.7));
  arrow.lineTo(tip + QPointF(-size * 0.75, size * 1.1));
  arrow.closeSubpath();
  painter.setPen(Qt::NoPen);
  painter.setBrush(QColor(0x1f, 0x6f, 0xb5));
  painter.drawPath(arrow);
}

void paintScaleBar(QPainter& painter, const MapView& view, QPointF right_bottom) {
  const double metres = roundLength(60.0, view.scale());
  const double wide = metres * view.scale();
  const QString text = metres < 0.995 ? QString::number(std::lround(metres * 100)) + " cm"
                                      : QString::number(metres, 'f', 0) + " m";
  const QRectF box(right_bottom.x() - wide - 20, right_bottom.y() - 34, wide + 20, 34);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(Qt::NoPen);
  painter.setBrush(QColor(12, 14, 17, 215));
  painter.drawRoundedRect(box, 5, 5);
  painter.setFont(theme::smallFont());
  painter.setPen(theme::kText);
  painter.drawText(QRectF(box.left(), box.top() + 2, box.width(), 18), Qt::AlignCenter, text);
  painter.setPen(QPen(theme::kText, 2));
  const double y = box.bottom() - 9;
  painter.drawPolyline(QPolygonF({{box.left() + 10, y - 4},
                                  {box.left() + 10, y},
                                  {box.right() - 10, y},
                                  {box.right() - 10, y - 4}}));
}

}  // namespace pilothouse::gui
