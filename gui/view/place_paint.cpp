// How the map that stays in place is painted.

#include <algorithm>
#include <cmath>

#include "gui/model/class_colours.hpp"
#include "gui/view/map_layers.hpp"
#include "gui/view/map_tool.hpp"
#include "gui/view/place_canvas.hpp"
#include "gui/view/theme.hpp"

namespace pilothouse::gui {

namespace {

constexpr double kLeastRobot = 22.0;  // px; a robot seen from afar stays visible

QColor colourOf(Severity severity) {
  switch (severity) {
    case Severity::kGood:
      return theme::kGood;
    case Severity::kNote:
      return theme::kAccent;
    case Severity::kWarning:
      return theme::kWarning;
    case Severity::kError:
      break;
  }
  return theme::kError;
}

LegendEntry cellEntry(MapCell cell) {
  return {QObject::tr(mapCellName(cell)), [cell](QPainter& painter, const QRectF& swatch) {
            const bool unknown = cell == MapCell::kUnknown;
            painter.fillRect(swatch, unknown ? theme::kWindow : QColor(mapCellColour(cell)));
            painter.setBrush(Qt::NoBrush);
            painter.setPen(QPen(theme::kMuted, 1.0));
            if (unknown) painter.drawRect(swatch.adjusted(0.7, 0.7, -0.7, -0.7));
            if (cell == MapCell::kDropOff) hatch(painter, swatch);
          }};
}

LegendEntry lineEntry(const QString& text, const QColor& colour, Qt::PenStyle style) {
  return {text, [=](QPainter& painter, const QRectF& swatch) {
            painter.setPen(QPen(colour, 2.5, style));
            painter.drawLine(QPointF(swatch.left() - 2, swatch.center().y()),
                             QPointF(swatch.right() + 2, swatch.center().y()));
          }};
}

LegendEntry boxEntry(const QString& text, const QColor& colour) {
  return {text, [=](QPainter& painter, const QRectF& swatch) { painter.fillRect(swatch, colour); }};
}

}  // namespace

void PlaceCanvas::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), theme::kWindow);
  paintGrid(painter, view_, size());
  paintScene(painter);
  if (tool_) tool_->paint(painter, view_);
  paintSigns(painter);
  paintWords(painter);
}

void PlaceCanvas::paintScene(QPainter& painter) {
  if (scene_.map && layer(PlaceLayer::kMap)) paintMap(painter, view_, *scene_.map);
  const PoseReading* pose = scene_.pose.get();
  if (pose && scene_.floor && layer(PlaceLayer::kFloor)) {
    painter.save();
    painter.setOpacity(0.75);
    inRobotFrame(painter, view_, pose->pose, 0.0, [&](const MapView& local) {
      paintFloor(painter, local, *scene_.floor, scene_.judged, false);
    });
    painter.restore();
  }
  if (scene_.standing && layer(PlaceLayer::kStanding)) {
    paintStanding(painter, view_, *scene_.standing);
  }
  if (layer(PlaceLayer::kTrail)) paintTrail(painter, view_, trail_);
  if (pose && scene_.objects && layer(PlaceLayer::kObjects)) {
    inRobotFrame(painter, view_, pose->pose, 0.0, [&](const MapView& local) {
      if (scene_.judged) {
        paintJudgedObjects(painter, local, *scene_.objects, std::nullopt, 3.0);
      } else {
        paintObjects(painter, local, *scene_.objects);
      }
    });
  }
  if (scene_.under_way && layer(PlaceLayer::kPath)) {
    if (scene_.path) paintPath(painter, view_, scene_.path->points, pathColour(), false);
    paintFlag(painter, view_, scene_.under_way->goal, scene_.under_way->heading);
  }
  if (pose && layer(PlaceLayer::kRobot)) paintRobotAt(painter);
}

void PlaceCanvas::paintRobotAt(QPainter& painter) {
  const PoseReading& pose = *scene_.pose;
  if (pose.spread_known) {
    paintSpread(painter, view_, pose.pose, pose.covariance, theme::kAccent);
  }
  double reach = 0.05;
  for (const auto& corner : outline_.corners()) reach = std::max(reach, corner.norm());
  painter.save();
  if (freshness(scene_.pose_state) == Freshness::kStale) painter.setOpacity(0.4);
  inRobotFrame(painter, view_, pose.pose, kLeastRobot / (2.0 * reach), [&](const MapView& local) {
    paintWay(painter, local, outline_, scene_.drive);
    paintRobot(painter, local, robot_);
  });
  painter.restore();
}

QVector<LegendEntry> PlaceCanvas::legend() const {
  QVector<LegendEntry> all;
  if (layer(PlaceLayer::kMap)) {
    for (const MapCell cell : {MapCell::kFree, MapCell::kThreshold, MapCell::kOccupied,
                               MapCell::kDropOff, MapCell::kUnknown}) {
      all << cellEntry(cell);
    }
  }
  if (layer(PlaceLayer::kFloor) && scene_.floor) {
    all << boxEntry(tr("floor now"), QColor(classColour(CellClass::kFloor)));
  }
  if (layer(PlaceLayer::kStanding) && scene_.standing) {
    all << boxEntry(tr("stays"), QColor(0x2f, 0x86, 0xff, 150));
  }
  if (layer(PlaceLayer::kObjects) && scene_.objects) {
    all << boxEntry(tr("in the way"), inTheWayColour(InTheWay::kYes));
  }
  if (layer(PlaceLayer::kPath)) all << lineEntry(tr("way"), pathColour(), Qt::SolidLine);
  if (layer(PlaceLayer::kTrail)) all << lineEntry(tr("trail"), trailColour(), Qt::DotLine);
  return all;
}

void PlaceCanvas::paintSigns(QPainter& painter) {
  const double margin = theme::kSpace;
  if (!scene_.map && !scene_.pose) {
    paintEmptyCard(painter, QRectF(0, 0, width(), height() * 0.7), scene_.words);
  }
  paintLegend(painter, {margin, height() - margin}, width() - 130.0, legend());
  paintScaleBar(painter, view_, {width() - margin, height() - margin});
  double top = margin + (tool_ ? kWordsHeight + margin : 0.0);
  if (!scene_.refused.empty()) {
    paintPill(painter, {margin, top}, Qt::AlignLeft | Qt::AlignTop,
              QString::fromStdString(scene_.refused), theme::kError);
    top += 26;
  }
  if (scene_.pose && freshness(scene_.pose_state) == Freshness::kStale) {
    const double age = scene_.pose_state.age_s;
    paintPill(painter, {margin, top}, Qt::AlignLeft | Qt::AlignTop,
              tr("Pose is %1 old: the robot may be elsewhere")
                  .arg(QString::fromStdString(timeWords(age))),
              theme::kError);
    top += 26;
  }
  const QString text = readoutText();
  if (!text.isEmpty()) {
    paintPill(painter, {margin, top}, Qt::AlignLeft | Qt::AlignTop, text, theme::kText);
  }
  if (follow_) {
    paintPill(painter, {width() - margin, top}, Qt::AlignRight | Qt::AlignTop,
              tr("follows the robot"), theme::kAccent);
  }
}

// What the tool is about and which keys go on, at the top.
void PlaceCanvas::paintWords(QPainter& painter) {
  if (!tool_) return;
  const AimWords words = tool_->words();
  const double margin = theme::kSpace;
  const QRectF box(margin, margin, width() - 2 * margin, kWordsHeight);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(Qt::NoPen);
  painter.setBrush(QColor(20, 24, 29, 240));
  painter.drawRoundedRect(box, 6, 6);
  painter.setBrush(colourOf(words.severity));
  painter.drawRoundedRect(QRectF(box.left(), box.top(), 4, box.height()), 2, 2);
  const QRectF text = box.adjusted(14, 4, -10, -5);
  const auto line = [&](const QFont& font, const QColor& colour, Qt::Alignment edge,
                        const std::string& words_of_it) {
    painter.setFont(font);
    painter.setPen(colour);
    painter.drawText(text, Qt::AlignLeft | edge,
                     QFontMetricsF(font).elidedText(QString::fromStdString(words_of_it),
                                                    Qt::ElideRight, text.width()));
  };
  line(theme::titleFont(), colourOf(words.severity), Qt::AlignTop, words.headline);
  line(theme::smallFont(), theme::kMuted, Qt::AlignBottom, words.advice);
}

}  // namespace pilothouse::gui
