// How a route that is being edited is painted.

#include "gui/view/map_layers.hpp"
#include "gui/view/overlay.hpp"
#include "gui/view/place_layers.hpp"
#include "gui/view/route_tool.hpp"
#include "gui/view/theme.hpp"

namespace pilothouse::gui {

/// The planned ways; straight where there is none yet, and in red where there is none at all. What
/// is being dragged is straight: its ways are those of before.
void RouteTool::paintLegs(QPainter& painter, const MapView& view, const RouteDraft& draft) const {
  const std::size_t count = draft.points.size();
  const std::size_t legs = count + (draft.loop && count > 1 ? 1 : 0);
  for (std::size_t i = 0; i < legs; ++i) {
    const Preview* way = dragged_to_ ? nullptr : ways_.legTo(i);
    if (way && way->found) {
      paintPath(painter, view, way->path.points, ghostColour(), true);
    } else if (i > 0) {
      const bool blocked = way && way->answered;
      paintPath(painter, view, {draft.points[i - 1].goal.place, draft.points[i % count].goal.place},
                blocked ? theme::kError : ghostColour(), true);
    }
  }
}

void RouteTool::paintPoint(QPainter& painter, const MapView& view, const DraftPoint& point,
                           std::size_t index) const {
  const bool chosen = selected_ == index;
  const bool under_way = under_way_ == index;
  const QColor colour = under_way ? pathColour() : ghostColour();
  if (chosen) {
    paintGhost(painter, view, outline_, point.goal.place, point.goal.heading, colour);
  } else if (point.goal.heading) {
    paintHeading(painter, view, point.goal.place, *point.goal.heading, colour);
  }
  const QPointF at = view.toPixel(point.goal.place.x(), point.goal.place.y());
  const double radius = chosen ? 12.0 : 10.0;
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(chosen ? QColor(Qt::white) : QColor(12, 14, 17, 230), chosen ? 2.2 : 2.0));
  painter.setBrush(colour);
  painter.drawEllipse(at, radius, radius);
  painter.setFont(theme::titleFont());
  painter.setPen(QColor(12, 14, 17));
  painter.drawText(QRectF(at.x() - 20, at.y() - 10, 40, 20), Qt::AlignCenter,
                   QString::number(index + 1));
  QStringList notes;
  if (under_way) notes << tr("under way");
  if (point.pause > 0.0)
    notes << tr("pauses %1").arg(QString::fromStdString(timeWords(point.pause)));
  if (notes.isEmpty()) return;
  paintPill(painter, at + QPointF(16, -10), Qt::AlignLeft, notes.join(", "), colour);
}

void RouteTool::paint(QPainter& painter, const MapView& view) {
  const RouteDraft draft = shown();
  paintLegs(painter, view, draft);
  for (std::size_t i = 0; i < draft.points.size(); ++i)
    paintPoint(painter, view, draft.points[i], i);
  if (!selected_) paintCross(painter, view, cross_);
}

}  // namespace pilothouse::gui
