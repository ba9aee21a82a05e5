#include "gui/view/place_canvas.hpp"

#include <QMouseEvent>
#include <algorithm>
#include <cmath>

#include "gui/model/class_colours.hpp"
#include "gui/view/map_tool.hpp"
#include "gui/view/theme.hpp"

namespace pilothouse::gui {

namespace {
constexpr double kMargin = 26.0;      // px round the fitted content
constexpr double kLegendRoom = 60.0;  // px at the bottom
constexpr double kGrip = 14.0;        // px; what counts as on a thing
constexpr int kDragBegins = 4;        // px
}  // namespace

PlaceCanvas::PlaceCanvas(const RobotDescription& robot, QWidget* parent)
    : MovableCanvas(MapView::Axes::kEastRight, parent), robot_(robot), outline_(robot.outline()) {
  layers_.set();
}

void PlaceCanvas::show(PlaceScene scene) {
  const auto extent = [](const PlaceScene& s) {
    return s.map ? QRectF(s.map->cells.origin_x, s.map->cells.origin_y, s.map->width(),
                          s.map->height())
                 : QRectF();
  };
  const bool grown = extent(scene) != extent(scene_);
  const bool first = !scene_.pose && scene.pose;
  if (scene.place != scene_.place) trail_.clear();
  scene_ = std::move(scene);
  if (scene_.pose) trail_.add(scene_.pose->pose.position());
  if (follow_ && scene_.pose) {
    view_.centreOn({scene_.pose->pose.x, scene_.pose->pose.y});
  } else if (fitted_ && !tool_ && (grown || first)) {  // never under somebody who aims
    fit();
  }
  update();
}

void PlaceCanvas::setLayer(PlaceLayer layer, bool on) {
  layers_[static_cast<std::size_t>(layer)] = on;
  update();
}

void PlaceCanvas::setTool(MapTool* tool) {
  tool_ = tool;
  aiming_ = false;
  setCursor(tool ? Qt::CrossCursor : Qt::ArrowCursor);
  update();
}

void PlaceCanvas::setFollow(bool on) {
  if (follow_ == on) return;
  follow_ = on;
  if (on) fitted_ = false;
  emit followChanged();
  update();
}

void PlaceCanvas::fit() {
  setFollow(false);
  fitted_ = true;
  QRectF box;
  if (scene_.map && !scene_.map->levels.empty()) {
    box = QRectF(scene_.map->cells.origin_x, scene_.map->cells.origin_y, scene_.map->width(),
                 scene_.map->height());
  }
  if (scene_.pose) {
    const Pose2& pose = scene_.pose->pose;
    const QRectF about(pose.x - 1.0, pose.y - 1.0, 2.0, 2.0);
    box = box.isEmpty() ? about.adjusted(-1.5, -1.5, 1.5, 1.5) : box.united(about);
  }
  if (box.isEmpty()) box = QRectF(-3.0, -3.0, 6.0, 6.0);
  view_.fit(box, {kMargin, tool_ ? kWordsHeight + kMargin : kMargin}, {kMargin, kLegendRoom});
  update();
}

Eigen::Vector2d PlaceCanvas::metresAt(QPointF pixel) const {
  const QPointF m = view_.toMetres(pixel);
  return {m.x(), m.y()};
}

Eigen::Vector2d PlaceCanvas::middle() const {
  return metresAt(middlePixel());
}

// A step is a round length of a few pixels, so that a key moves alike at every zoom.
void PlaceCanvas::nudge(int right, int up, bool fine) {
  if (!tool_) return;
  const double step = roundLength(fine ? 1.5 : 8.0, view_.scale());
  tool_->nudge(Eigen::Vector2d(right, up) * step);
  update();
}

QString PlaceCanvas::readoutText() const {
  if (!cursor_) return {};
  const Eigen::Vector2d m = metresAt(*cursor_);
  QString text = tr("x %1 m   y %2 m").arg(m.x(), 0, 'f', 2).arg(m.y(), 0, 'f', 2);
  if (!scene_.map || std::abs(m.x()) > 1e5 || std::abs(m.y()) > 1e5) return text;
  const MapCells& cells = scene_.map->cells;
  const int column = cells.column(m.x()), row = cells.row(m.y());
  if (cells.contains(column, row)) {
    text += "   " + QString::fromLatin1(mapCellName(cells.at(column, row)));
  }
  return text;
}

void PlaceCanvas::mousePressEvent(QMouseEvent* event) {
  dragged_from_ = event->localPos();
  if (tool_ && event->button() == Qt::LeftButton) {
    aiming_ = true;
    tool_->press(metresAt(event->localPos()), reach(kGrip));
    update();
    return;
  }
  panning_ = true;
  panned_ = false;
  if (!tool_) setCursor(Qt::ClosedHandCursor);
}

void PlaceCanvas::mouseMoveEvent(QMouseEvent* event) {
  cursor_ = event->localPos();
  if (aiming_ && tool_) {
    tool_->drag(metresAt(event->localPos()), reach(kGrip));
  } else if (panning_) {
    const QPointF moved = event->localPos() - dragged_from_;
    if (!panned_ && moved.manhattanLength() < kDragBegins) return;
    panned_ = true;
    dragged_from_ = event->localPos();
    panBy(moved);
  }
  update();
}

void PlaceCanvas::mouseReleaseEvent(QMouseEvent* event) {
  if (aiming_ && event->button() == Qt::LeftButton) {
    aiming_ = false;
    if (tool_) tool_->release();
  } else if (panning_) {
    panning_ = false;
    setCursor(tool_ ? Qt::CrossCursor : Qt::ArrowCursor);
    if (tool_ && !panned_ && event->button() == Qt::RightButton) emit takenBack();
  }
  update();
}

void PlaceCanvas::mouseDoubleClickEvent(QMouseEvent* event) {
  if (tool_) return mousePressEvent(event);  // the second of two quick clicks is a click
  fit();
}

}  // namespace pilothouse::gui
