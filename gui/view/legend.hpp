#pragma once

#include <QPainter>
#include <QString>
#include <QVector>
#include <functional>

namespace pilothouse::gui {

/// One sign of a map with its word.
struct LegendEntry {
  QString text;
  std::function<void(QPainter&, const QRectF&)> swatch;
};

/// A box with the entries in as many rows as needed.
void paintLegend(QPainter& painter, QPointF left_bottom, double most_width,
                 const QVector<LegendEntry>& entries);

}  // namespace pilothouse::gui
