#include "gui/view/map_drive.hpp"

#include <QPainterPath>
#include <algorithm>
#include <cmath>

#include "gui/model/class_colours.hpp"
#include "gui/model/swept_outline.hpp"
#include "gui/view/map_layers.hpp"
#include "gui/view/overlay.hpp"
#include "gui/view/theme.hpp"

namespace pilothouse::gui {

namespace {

const QColor kRanger(0x7d, 0xe3, 0xd2);
const QColor kWay(0x8f, 0xc9, 0xff);

QPolygonF onMap(const MapView& view, const std::vector<Eigen::Vector2d>& points) {
  QPolygonF out;
  for (const auto& p : points) out << view.toPixel(p.x(), p.y());
  return out;
}

bool within(const std::optional<HeightBand>& band, float z) {
  return band && double(z) >= band->low && double(z) <= band->high;  // false for NaN
}

QPainterPath sector(const MapView& view, const RangerMark& r, double range) {
  QPainterPath path(view.toPixel(r.x, r.y));
  constexpr int kSteps = 12;
  for (int i = 0; i <= kSteps; ++i) {
    const double angle = r.yaw + r.field_of_view * (static_cast<double>(i) / kSteps - 0.5);
    path.lineTo(view.toPixel(r.x + range * std::cos(angle), r.y + range * std::sin(angle)));
  }
  return path;
}

}  // namespace

QColor inTheWayColour(InTheWay relevance) {
  switch (relevance) {
    case InTheWay::kYes:
      return {0xe8, 0x3c, 0x32};
    case InTheWay::kPotential:
      return {0xf5, 0x9a, 0x23};
    case InTheWay::kOther:
      break;
  }
  return {0x5a, 0xae, 0xff};
}

QColor atHeightColour() {
  return {0xa9, 0x5c, 0xff};
}

void paintObjectMark(QPainter& painter, const QRectF& box, const ObjectMark& object,
                     bool at_height) {
  const bool ground = object.kind != CellClass::kObstacle;  // thresholds and drop-offs keep theirs
  const QColor judged = inTheWayColour(object.relevance);
  const QColor fill = ground ? QColor(classColour(object.kind)) : judged;
  const QRectF inner = box.adjusted(0.7, 0.7, -0.7, -0.7);
  if (object.remembered) {
    painter.setPen(QPen(fill, 1.6));
    painter.setBrush(QColor(18, 21, 25, 170));
    painter.drawRect(inner);
  } else {
    const bool rimmed = ground && object.relevance != InTheWay::kOther;
    painter.setPen(rimmed ? QPen(judged, 1.8) : QPen(fill.darker(170), 1.0));
    painter.setBrush(fill);
    painter.drawRect(inner);
    if (object.kind == CellClass::kDropOff) hatch(painter, box);
  }
  if (!ground && object.relevance != InTheWay::kOther && box.width() >= 6.0) {
    painter.setPen(QPen(object.remembered ? fill : QColor(40, 12, 8, 220), 1.2));
    painter.drawLine(inner.topLeft(), inner.bottomRight());
    if (object.relevance == InTheWay::kYes) {
      painter.drawLine(inner.topRight(), inner.bottomLeft());
    }
  }
  if (!at_height) return;
  const QPointF c = box.center();
  const double r = std::max(3.0, box.width() * 0.5);
  painter.setPen(QPen(QColor(0x24, 0x0c, 0x44), 1));
  painter.setBrush(atHeightColour());
  painter.drawPolygon(
      QPolygonF({{c.x(), c.y() - r}, {c.x() + r, c.y()}, {c.x(), c.y() + r}, {c.x() - r, c.y()}}));
}

void paintJudgedObjects(QPainter& painter, const MapView& view, const ObjectsPicture& objects,
                        const std::optional<HeightBand>& band, double least_side) {
  painter.setRenderHint(QPainter::Antialiasing);
  // What matters most lies on top.
  for (const auto layer : {InTheWay::kOther, InTheWay::kPotential, InTheWay::kYes}) {
    for (const auto& object : objects.objects) {
      if (object.relevance != layer) continue;
      const double side = std::max(least_side, double(object.size) * view.scale());
      const QPointF centre = view.toPixel(double(object.x), double(object.y));
      paintObjectMark(painter, QRectF(centre.x() - side / 2, centre.y() - side / 2, side, side),
                      object, within(band, object.z));
    }
  }
}

void paintRangers(QPainter& painter, const MapView& view, const std::vector<RangerMark>& rangers) {
  painter.setRenderHint(QPainter::Antialiasing);
  for (const auto& r : rangers) {
    if (std::isnan(r.range)) continue;
    const bool sees = std::isfinite(r.range);
    const double range = sees ? r.range : r.max;
    QPainterPath cone = sector(view, r, range);
    cone.closeSubpath();
    painter.setPen(
        QPen(QColor(0x7d, 0xe3, 0xd2, sees ? 130 : 60), 1, sees ? Qt::SolidLine : Qt::DotLine));
    painter.setBrush(QColor(0x7d, 0xe3, 0xd2, sees ? 30 : 10));
    painter.drawPath(cone);
    if (!sees) continue;
    // The arc on which something is, with its distance.
    QPainterPath arc;
    constexpr int kSteps = 12;
    for (int i = 0; i <= kSteps; ++i) {
      const double angle = r.yaw + r.field_of_view * (static_cast<double>(i) / kSteps - 0.5);
      const QPointF at = view.toPixel(r.x + range * std::cos(angle), r.y + range * std::sin(angle));
      if (i == 0) {
        arc.moveTo(at);
      } else {
        arc.lineTo(at);
      }
    }
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(kRanger, 3, Qt::SolidLine, Qt::RoundCap));
    painter.drawPath(arc);
  }
}

void paintWay(QPainter& painter, const MapView& view, const Footprint& footprint,
              const DriveOverlay& drive) {
  if (!drive.wish) return;
  // As far as the way is free.
  const double free = drive.limit.obstacle_distance;
  const double way =
      std::isfinite(free) ? std::clamp(free, 0.02, drive.look_ahead) : drive.look_ahead;
  const SweptOutline swept = sweptOutline(footprint, *drive.wish, way);
  if (swept.outlines.empty()) return;
  painter.setRenderHint(QPainter::Antialiasing);
  QPainterPath area;
  area.setFillRule(Qt::WindingFill);
  for (const auto& outline : swept.outlines) {
    area.addPolygon(onMap(view, outline));
    area.closeSubpath();
  }
  painter.fillPath(area, QColor(kWay.red(), kWay.green(), kWay.blue(), 40));
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(QColor(kWay.red(), kWay.green(), kWay.blue(), 200), 1.4, Qt::DashLine));
  painter.drawPolyline(onMap(view, swept.left));
  painter.drawPolyline(onMap(view, swept.right));
  const bool ends = drive.limits && std::isfinite(drive.limit.distance) &&
                    drive.limit.distance < drive.look_ahead;
  if (!ends) return;
  // The robot where it would touch.
  const auto there = footprintAfter(footprint, *drive.wish, std::max(0.0, drive.limit.distance));
  const bool stops = drive.limit.cause != LimitCause::kPotential;
  painter.setPen(
      QPen(inTheWayColour(stops ? InTheWay::kYes : InTheWay::kPotential), 1.6, Qt::DotLine));
  painter.drawPolygon(onMap(view, there));
}

void paintCause(QPainter& painter, const MapView& view, const DriveOverlay& drive) {
  const LimitReading& limit = drive.limit;
  const bool thing = limit.cause == LimitCause::kObstacle ||
                     limit.cause == LimitCause::kPotential || limit.cause == LimitCause::kBraking ||
                     limit.cause == LimitCause::kThreshold;
  if (!drive.limits || !thing || !std::isfinite(limit.x) || !std::isfinite(limit.y)) return;
  const QPointF at = view.toPixel(limit.x, limit.y);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(QColor(12, 14, 17, 230), 5));
  painter.drawEllipse(at, 12, 12);
  painter.setPen(QPen(Qt::white, 2));
  painter.drawEllipse(at, 12, 12);
  if (!std::isfinite(limit.distance)) return;
  const bool left = limit.y > 0.0;  // the pill keeps off the way
  paintPill(painter, at + QPointF(left ? -18 : 18, -10), left ? Qt::AlignRight : Qt::AlignLeft,
            QObject::tr("%1 m free").arg(std::max(0.0, limit.distance), 0, 'f', 2), Qt::white);
}

}  // namespace pilothouse::gui
