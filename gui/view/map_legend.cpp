#include <QVector>
#include <functional>

#include "gui/model/class_colours.hpp"
#include "gui/view/legend.hpp"
#include "gui/view/map_drive.hpp"
#include "gui/view/map_layers.hpp"
#include "gui/view/theme.hpp"

namespace pilothouse::gui {

namespace {

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

QVector<LegendEntry> entries(const LegendOf& of) {
  const auto tr = [](const char* text) { return QObject::tr(text); };
  QVector<LegendEntry> all{{tr("floor"), cell(CellClass::kFloor)},
                           {tr("threshold"), cell(CellClass::kThreshold)}};
  if (!of.judged) all << LegendEntry{tr("obstacle"), cell(CellClass::kObstacle)};
  all << LegendEntry{tr("drop-off"), cell(CellClass::kDropOff)}
      << LegendEntry{tr("unknown"), cell(CellClass::kUnknown)};
  if (!of.judged) {
    all << LegendEntry{tr("nearest of its row"), cell(CellClass::kObstacle, true)};
  } else {
    all << LegendEntry{tr("in the way"), object(InTheWay::kYes, false, false)}
        << LegendEntry{tr("beside"), object(InTheWay::kPotential, false, false)}
        << LegendEntry{tr("other"), object(InTheWay::kOther, false, false)}
        << LegendEntry{tr("remembered"), object(InTheWay::kOther, true, false)};
    if (of.heights) all << LegendEntry{tr("at the height"), object(InTheWay::kOther, false, true)};
  }
  if (of.rangers) all << LegendEntry{tr("ranger"), rangerSwatch};
  return all;
}

}  // namespace

void paintLegend(QPainter& painter, QPointF left_bottom, double most_width, LegendOf of) {
  paintLegend(painter, left_bottom, most_width, entries(of));
}

}  // namespace pilothouse::gui
