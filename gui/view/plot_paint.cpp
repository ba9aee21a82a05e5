#include <QPainter>
#include <QPolygonF>
#include <algorithm>
#include <cmath>

#include "gui/model/map_view.hpp"
#include "gui/view/overlay.hpp"
#include "gui/view/plot.hpp"
#include "gui/view/theme.hpp"

namespace pilothouse::gui {

namespace {

constexpr double kBand = 13.0;  // px of the rules
const QColor kGridLine(0x2b, 0x32, 0x3c);

QString figure(double value, double step) {
  return QString::number(std::abs(value) < 1e-9 ? 0.0 : value, 'f',
                         step < 0.0095  ? 3
                         : step < 0.095 ? 2
                         : step < 0.95  ? 1
                                        : 0);
}

// Patterns beside the colours, so that the rules stay apart for every eye.
Qt::BrushStyle rulePattern(Rule rule) {
  switch (rule) {
    case Rule::kPotential:
      return Qt::Dense3Pattern;
    case Rule::kThreshold:
      return Qt::VerPattern;
    case Rule::kUnseen:
      return Qt::FDiagPattern;
    case Rule::kStale:
    case Rule::kBadCommand:
      return Qt::DiagCrossPattern;
    case Rule::kStopped:
      return Qt::BDiagPattern;
    case Rule::kFree:
    case Rule::kObstacle:
    case Rule::kBraking:
      break;
  }
  return Qt::SolidPattern;
}

}  // namespace

QColor ruleColour(Rule rule) {
  switch (rule) {
    case Rule::kFree:
      return {0x2c, 0x6e, 0x55};
    case Rule::kObstacle:
      return {0xe4, 0x45, 0x3a};
    case Rule::kPotential:
      return {0xf0, 0x9a, 0x28};
    case Rule::kBraking:
      return {0xff, 0x8f, 0xc4};
    case Rule::kThreshold:
      return {0xf0, 0xe4, 0x42};
    case Rule::kUnseen:
      return {0x8a, 0x97, 0xa8};
    case Rule::kStale:
    case Rule::kBadCommand:
      return {0xd0, 0xd6, 0xde};
    case Rule::kStopped:
      break;
  }
  return {0xc0, 0x39, 0x30};
}

QString ruleName(Rule rule) {
  switch (rule) {
    case Rule::kFree:
      return QObject::tr("free");
    case Rule::kObstacle:
      return QObject::tr("obstacle");
    case Rule::kPotential:
      return QObject::tr("beside");
    case Rule::kBraking:
      return QObject::tr("braking");
    case Rule::kThreshold:
      return QObject::tr("threshold");
    case Rule::kUnseen:
      return QObject::tr("unseen");
    case Rule::kStale:
      return QObject::tr("stale");
    case Rule::kBadCommand:
      return QObject::tr("bad command");
    case Rule::kStopped:
      break;
  }
  return QObject::tr("stopped");
}

void Plot::paintAxes(QPainter& painter, const QRectF& field) const {
  painter.setFont(theme::smallFont());
  painter.setRenderHint(QPainter::Antialiasing, false);
  const double step = roundLength(26.0, field.height() / (high_ - low_));
  for (double v = std::ceil(low_ / step) * step; v <= high_ + 1e-9; v += step) {
    const double y = std::round(toPixel(field, time_.end(), v).y());
    painter.setPen(kGridLine);
    painter.drawLine(QPointF(field.left(), y), QPointF(field.right(), y));
    painter.setPen(theme::kMuted);
    painter.drawText(QRectF(0, y - 9, field.left() - 5, 18), Qt::AlignRight | Qt::AlignVCenter,
                     figure(v, step));
  }
  // Marks at whole steps before now, so that they run with the curves and not against them.
  const double every = roundLength(80.0, field.width() / time_.span);
  for (double back = std::ceil((time_.now - time_.end()) / every) * every;
       time_.now - back >= time_.begin(); back += every) {
    const double x = std::round(toPixel(field, time_.now - back, low_).x());
    painter.setPen(kGridLine);
    painter.drawLine(QPointF(x, field.top()), QPointF(x, field.bottom()));
    if (!time_axis_) continue;
    painter.setPen(theme::kMuted);
    const QString text = back < every / 2 ? tr("now") : tr("-%1 s").arg(figure(back, every));
    QRectF box(x - 40, field.bottom() + 2, 80, 16);
    if (box.right() > width() - 2) box.moveRight(width() - 2);
    painter.drawText(box, box.center().x() < x - 1 ? Qt::AlignRight : Qt::AlignHCenter, text);
  }
}

void Plot::paintRules(QPainter& painter, const QRectF& field) const {
  if (!rule_band_) return;
  painter.setFont(theme::smallFont());
  const double top = field.top() - kBand - 2.0;
  for (std::size_t i = 0; i < rules_.size(); ++i) {
    const std::size_t first = i;  // one box for a rule, also where its reason changes
    while (i + 1 < rules_.size() && rules_[i + 1].rule == rules_[first].rule &&
           rules_[i + 1].at == rules_[i].until) {
      ++i;
    }
    const double from = std::max(rules_[first].at, time_.begin());
    const double to = std::min(endOf(i), time_.end());
    if (to <= from) continue;
    const QRectF box(QPointF(toPixel(field, from, 0).x(), top),
                     QPointF(toPixel(field, to, 0).x(), top + kBand));
    const QColor colour = ruleColour(rules_[i].rule);
    painter.setRenderHint(QPainter::Antialiasing, false);
    painter.fillRect(box, colour.darker(220));
    painter.fillRect(box, QBrush(colour, rulePattern(rules_[i].rule)));
    if (rules_[first].at > time_.begin()) {
      QPen pen(QColor(colour.red(), colour.green(), colour.blue(), 110), 1, Qt::DotLine);
      painter.setPen(pen);
      painter.drawLine(QPointF(box.left(), box.bottom()), QPointF(box.left(), field.bottom()));
    }
    const QString name = ruleName(rules_[i].rule);
    const double wide = painter.fontMetrics().horizontalAdvance(name) + 8.0;
    if (box.width() < wide + 4.0) continue;
    painter.fillRect(QRectF(box.left() + 2, top, wide, kBand), QColor(12, 14, 17, 190));
    painter.setPen(theme::kText);
    painter.drawText(QRectF(box.left() + 6, top - 2, wide, kBand + 3), Qt::AlignVCenter, name);
  }
}

void Plot::paintCurves(QPainter& painter, const QRectF& field) const {
  painter.save();
  painter.setClipRect(field.adjusted(0, -1, 1, 1));
  for (const auto& level : levels_) {
    const double y = std::round(toPixel(field, 0, level.value).y()) + 0.5;
    painter.setPen(QPen(level.colour, 1.4, Qt::DashLine));
    painter.drawLine(QPointF(field.left(), y), QPointF(field.right(), y));
    painter.setFont(theme::smallFont());
    painter.drawText(QRectF(field.left() + 6, y - 17, 300, 16), Qt::AlignLeft | Qt::AlignBottom,
                     tr("%1 %2 %3").arg(level.name).arg(level.value, 0, 'f', 2).arg(unit_));
  }
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setBrush(Qt::NoBrush);
  QPolygonF line;
  for (const auto& series : series_) {
    if (!series.shown) continue;
    painter.setPen(QPen(series.colour, series.width, series.style, Qt::FlatCap, Qt::BevelJoin));
    line.clear();
    for (const auto& point : series.points) {
      if (std::isnan(point.value)) {
        if (line.size() > 1) painter.drawPolyline(line);
        line.clear();
      } else {
        line << toPixel(field, point.t, point.value);
      }
    }
    if (line.size() > 1) painter.drawPolyline(line);
  }
  painter.restore();
}

void Plot::paintLegend(QPainter& painter) const {
  painter.setFont(theme::smallFont());
  painter.setPen(theme::kText);
  painter.drawText(QRectF(38.0, 3.0, 300, 18), Qt::AlignLeft | Qt::AlignVCenter, title_);
  for (const auto& chip : chips()) {
    const Series& series = series_[chip.series];
    const double middle = chip.box.center().y();
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QPen(series.shown ? series.colour : theme::kLine, 2.5, series.style));
    painter.drawLine(QPointF(chip.box.left(), middle), QPointF(chip.box.left() + 14, middle));
    painter.setPen(series.shown ? theme::kText : QColor(0x6f, 0x7a, 0x88));
    painter.drawText(chip.box.adjusted(19, 0, 0, 0), Qt::AlignLeft | Qt::AlignVCenter, series.name);
    if (!series.shown) continue;
    painter.setPen(theme::kMuted);
    painter.drawText(chip.box, Qt::AlignRight | Qt::AlignVCenter, chip.text);
  }
}

void Plot::paintCursor(QPainter& painter, const QRectF& field) const {
  if (!time_.cursor) return;
  const double x = std::round(toPixel(field, *time_.cursor, 0).x()) + 0.5;
  if (x < field.left() || x > field.right()) return;
  painter.setRenderHint(QPainter::Antialiasing, false);
  painter.setPen(QPen(QColor(0xe8, 0xec, 0xf1, 150), 1));
  painter.drawLine(QPointF(x, field.top()), QPointF(x, field.bottom()));
  painter.setRenderHint(QPainter::Antialiasing);
  for (const auto& series : series_) {
    if (!series.shown || !std::isfinite(series.under_cursor)) continue;
    const QPointF at = toPixel(field, *time_.cursor, series.under_cursor);
    if (!field.adjusted(-1, -1, 1, 1).contains(at)) continue;
    painter.setPen(QPen(theme::kPanel, 1.5));
    painter.setBrush(series.colour);
    painter.drawEllipse(QPointF(x, at.y()), 3.5, 3.5);
  }
  QString text = readoutText();
  if (text.isEmpty()) return;
  painter.setFont(theme::smallFont());
  const auto boxOf = [&] {
    return painter.boundingRect(QRectF(0, 0, 320, 400), Qt::TextWordWrap, text)
        .adjusted(-8, -5, 8, 5);
  };
  QRectF box = boxOf();
  if (box.height() > field.height() - 8) {  // the legend tells the values as well
    text = readoutText(false);
    box = boxOf();
  }
  box.moveTop(field.top() + 4);
  // On the roomier side of the cursor.
  if (x < field.center().x()) {
    box.moveLeft(x + 10);
  } else {
    box.moveRight(x - 10);
  }
  painter.setPen(QPen(theme::kLine, 1));
  painter.setBrush(QColor(12, 14, 17, 225));
  painter.drawRoundedRect(box, 5, 5);
  painter.setPen(theme::kText);
  painter.drawText(box.adjusted(8, 5, -8, -5), Qt::TextWordWrap, text);
}

void Plot::paintEvent(QPaintEvent*) {
  chooseScale();
  QPainter painter(this);
  painter.fillRect(rect(), theme::kPanel);
  const QRectF area = field();
  painter.fillRect(area, theme::kWindow);
  paintAxes(painter, area);
  paintRules(painter, area);
  paintCurves(painter, area);
  paintLegend(painter);
  paintCursor(painter, area);
}

}  // namespace pilothouse::gui
