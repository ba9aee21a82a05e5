#include <QVector>
#include <algorithm>

#include "gui/model/class_colours.hpp"
#include "gui/view/map_layers.hpp"
#include "gui/view/theme.hpp"

namespace pilothouse::gui {

namespace {

constexpr double kRow = 20.0;
constexpr double kSwatch = 12.0;
constexpr double kPad = 10.0;
constexpr double kGap = 16.0;  // between entries

struct Entry {
  CellClass kind;
  QString text;
  bool outlined;
  QPointF place = {};  // within the box
  double width = 0.0;
};

QVector<Entry> entries() {
  return {{CellClass::kFloor, QObject::tr("floor"), false},
          {CellClass::kThreshold, QObject::tr("threshold"), false},
          {CellClass::kObstacle, QObject::tr("obstacle"), false},
          {CellClass::kDropOff, QObject::tr("drop-off"), false},
          {CellClass::kUnknown, QObject::tr("unknown"), false},
          {CellClass::kObstacle, QObject::tr("nearest of its row"), true}};
}

// Places the entries in rows. @return the size of the box.
QSizeF arrange(QVector<Entry>& all, double most_width) {
  const QFontMetricsF metrics(theme::smallFont());
  double x = kPad;
  double y = 4.0;
  double widest = 0.0;
  for (auto& entry : all) {
    entry.width = kSwatch + 6 + metrics.horizontalAdvance(entry.text);
    if (x > kPad && x + entry.width + kPad > most_width) {
      x = kPad;
      y += kRow;
    }
    entry.place = {x, y};
    widest = std::max(widest, x + entry.width);
    x += entry.width + kGap;
  }
  return {widest + kPad, y + kRow + 4.0};
}

void paintSwatch(QPainter& painter, const Entry& entry, QPointF corner) {
  const QRectF swatch(corner.x(), corner.y() + (kRow - kSwatch) / 2, kSwatch, kSwatch);
  const bool unknown = entry.kind == CellClass::kUnknown;
  painter.fillRect(swatch, unknown ? theme::kWindow : QColor(classColour(entry.kind)));
  painter.setBrush(Qt::NoBrush);
  if (entry.outlined || unknown) {
    painter.setPen(QPen(entry.outlined ? QColor(Qt::white) : theme::kMuted, 1.4));
    painter.drawRect(swatch.adjusted(0.7, 0.7, -0.7, -0.7));
  }
  if (entry.kind == CellClass::kDropOff) hatch(painter, swatch);
}

}  // namespace

void paintLegend(QPainter& painter, QPointF left_bottom, double most_width) {
  auto all = entries();
  const QSizeF size = arrange(all, most_width);
  const QPointF corner(left_bottom.x(), left_bottom.y() - size.height());
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(Qt::NoPen);
  painter.setBrush(QColor(12, 14, 17, 215));
  painter.drawRoundedRect(QRectF(corner, size), 5, 5);
  painter.setFont(theme::smallFont());
  for (const auto& entry : all) {
    const QPointF place = corner + entry.place;
    paintSwatch(painter, entry, place);
    painter.setPen(theme::kText);
    painter.drawText(QRectF(place.x() + kSwatch + 6, place.y(), entry.width, kRow),
                     Qt::AlignLeft | Qt::AlignVCenter, entry.text);
  }
}

}  // namespace pilothouse::gui
