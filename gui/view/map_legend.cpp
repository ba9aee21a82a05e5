#include <QVector>
#include <algorithm>
#include <functional>

#include "gui/model/class_colours.hpp"
#include "gui/view/map_drive.hpp"
#include "gui/view/map_layers.hpp"
#include "gui/view/theme.hpp"

namespace pilothouse::gui {

namespace {

constexpr double kRow = 20.0;
constexpr double kSwatch = 12.0;
constexpr double kPad = 10.0;
constexpr double kGap = 16.0;  // between entries

struct Entry {
  QString text;
  std::function<void(QPainter&, const QRectF&)> swatch;
  QPointF place = {};  // within the box
  double width = 0.0;
};

std::function<void(QPainter&, const QRectF&)> cell(CellClass kind, bool outlined = false) {
  return [=](QPainter& painter, const QRectF& swatch) {
    const bool unknown = kind == CellClass::kUnknown;
    painter.fillRect(swatch, unknown ? theme::kWindow : QColor(classColour(kind)));
    painter.setBrush(Qt::NoBrush);
    if (outlined || unknown) {
      painter.setPen(QPen(outlined ? QColor(Qt::white) : theme::kMuted, 1.4));
      painter.drawRect(swatch.adjusted(0.7, 0.7, -0.7, -0.7));
    }
    if (kind == CellClass::kDropOff) hatch(painter, swatch);
  };
}

std::function<void(QPainter&, const QRectF&)> object(InTheWay relevance, bool remembered,
                                                     bool at_height) {
  return [=](QPainter& painter, const QRectF& swatch) {
    ObjectMark mark{0.0F, 0.0F, 1.0F, CellClass::kObstacle, false, relevance, 0.0F, remembered};
    paintObjectMark(painter, swatch, mark, at_height);
  };
}

void rangerSwatch(QPainter& painter, const QRectF& swatch) {
  painter.setPen(QPen(QColor(0x7d, 0xe3, 0xd2), 2.5, Qt::SolidLine, Qt::RoundCap));
  painter.drawArc(swatch.adjusted(-3, 2, 3, 14), 50 * 16, 80 * 16);
}

QVector<Entry> entries(const LegendOf& of) {
  const auto tr = [](const char* text) { return QObject::tr(text); };
  QVector<Entry> all{{tr("floor"), cell(CellClass::kFloor)},
                     {tr("threshold"), cell(CellClass::kThreshold)}};
  if (!of.judged) all << Entry{tr("obstacle"), cell(CellClass::kObstacle)};
  all << Entry{tr("drop-off"), cell(CellClass::kDropOff)}
      << Entry{tr("unknown"), cell(CellClass::kUnknown)};
  if (!of.judged) {
    all << Entry{tr("nearest of its row"), cell(CellClass::kObstacle, true)};
  } else {
    all << Entry{tr("in the way"), object(InTheWay::kYes, false, false)}
        << Entry{tr("beside"), object(InTheWay::kPotential, false, false)}
        << Entry{tr("other"), object(InTheWay::kOther, false, false)}
        << Entry{tr("remembered"), object(InTheWay::kOther, true, false)};
    if (of.heights) all << Entry{tr("at the height"), object(InTheWay::kOther, false, true)};
  }
  if (of.rangers) all << Entry{tr("ranger"), rangerSwatch};
  return all;
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

}  // namespace

void paintLegend(QPainter& painter, QPointF left_bottom, double most_width, LegendOf of) {
  auto all = entries(of);
  const QSizeF size = arrange(all, most_width);
  const QPointF corner(left_bottom.x(), left_bottom.y() - size.height());
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(Qt::NoPen);
  painter.setBrush(QColor(12, 14, 17, 215));
  painter.drawRoundedRect(QRectF(corner, size), 5, 5);
  painter.setFont(theme::smallFont());
  for (const auto& entry : all) {
    const QPointF place = corner + entry.place;
    entry.swatch(painter, QRectF(place.x(), place.y() + (kRow - kSwatch) / 2, kSwatch, kSwatch));
    painter.setPen(theme::kText);
    painter.drawText(QRectF(place.x() + kSwatch + 6, place.y(), entry.width, kRow),
                     Qt::AlignLeft | Qt::AlignVCenter, entry.text);
  }
}

}  // namespace pilothouse::gui
