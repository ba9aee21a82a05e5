#include "gui/view/legend.hpp"

#include <algorithm>

#include "gui/view/theme.hpp"

namespace pilothouse::gui {

namespace {

constexpr double kRow = 20.0;
constexpr double kSwatch = 12.0;
constexpr double kPad = 10.0;
constexpr double kGap = 16.0;  // between entries

struct Place {
  QPointF corner;  ///< within the box
  double width;
};

// Places the entries in rows. @return the size of the box.
QSizeF arrange(const QVector<LegendEntry>& entries, double most_width, QVector<Place>& places) {
  const QFontMetricsF metrics(theme::smallFont());
  double x = kPad;
  double y = 4.0;
  double widest = 0.0;
  for (const auto& entry : entries) {
    const double width = kSwatch + 6 + metrics.horizontalAdvance(entry.text);
    if (x > kPad && x + width + kPad > most_width) {
      x = kPad;
      y += kRow;
    }
    places << Place{{x, y}, width};
    widest = std::max(widest, x + width);
    x += width + kGap;
  }
  return {widest + kPad, y + kRow + 4.0};
}

}  // namespace

void paintLegend(QPainter& painter, QPointF left_bottom, double most_width,
                 const QVector<LegendEntry>& entries) {
  QVector<Place> places;
  const QSizeF size = arrange(entries, most_width, places);
  const QPointF corner(left_bottom.x(), left_bottom.y() - size.height());
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(Qt::NoPen);
  painter.setBrush(QColor(12, 14, 17, 215));
  painter.drawRoundedRect(QRectF(corner, size), 5, 5);
  painter.setFont(theme::smallFont());
  for (int i = 0; i < entries.size(); ++i) {
    const QPointF place = corner + places[i].corner;
    entries[i].swatch(painter,
                      QRectF(place.x(), place.y() + (kRow - kSwatch) / 2, kSwatch, kSwatch));
    painter.setPen(theme::kText);
    painter.drawText(QRectF(place.x() + kSwatch + 6, place.y(), places[i].width, kRow),
                     Qt::AlignLeft | Qt::AlignVCenter, entries[i].text);
  }
}

}  // namespace pilothouse::gui
