#include "gui/view/map_canvas.hpp"

#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <cmath>

#include "gui/model/class_colours.hpp"
#include "gui/view/map_layers.hpp"
#include "gui/view/theme.hpp"

namespace pilothouse::gui {

namespace {
constexpr double kUsualHalfAngle = 0.5;  // rad, about a Kinect's 57 degrees
constexpr double kConeLength = 4.0;      // m, until a grid tells how far it reaches
constexpr double kRadians = 3.14159265358979323846 / 180.0;
constexpr double kMargin = 22.0;      // px round the fitted content
constexpr double kLegendRoom = 52.0;  // px at the bottom
}  // namespace

MapCanvas::MapCanvas(const RobotDescription& robot, QWidget* parent)
    : MovableCanvas(MapView::Axes::kForwardUp, parent),
      robot_(robot),
      outline_(robot.outline()),
      half_angle_(kUsualHalfAngle) {}

void MapCanvas::setFloor(std::shared_ptr<const FloorPicture> floor) {
  const bool moved = !floor_ || floor->geometry.size_x != floor_->geometry.size_x ||
                     floor->geometry.size_y != floor_->geometry.size_y;
  floor_ = std::move(floor);
  if (moved && fitted_) fit();
  update();
}

void MapCanvas::setObjects(std::shared_ptr<const ObjectsPicture> objects) {
  objects_ = std::move(objects);  // drawn with the next grid: both come in pairs
}

void MapCanvas::setDrive(DriveOverlay drive) {
  drive_ = std::move(drive);
}

void MapCanvas::setHeightBand(std::optional<HeightBand> band) {
  band_ = band;
  update();
}

void MapCanvas::setCamera(std::optional<CameraPose> pose, std::optional<double> half_angle) {
  camera_ = pose;
  half_angle_ = half_angle.value_or(kUsualHalfAngle);
}

void MapCanvas::setState(const FeedState& state, const EmptyWords& words) {
  state_ = state;
  words_ = words;
  update();
}

QRectF MapCanvas::content() const {
  QRectF box(0, -1.5, 3.5, 3.0);  // x, y in metres before any grid has come
  if (floor_) {
    const GridGeometry& g = floor_->geometry;
    box = QRectF(double(g.x_min), double(g.y_min), double(g.cell_size) * g.size_x,
                 double(g.cell_size) * g.size_y);
  }
  for (const auto& point : robot_.footprint) {
    box.setLeft(std::min(box.left(), point[0] - 0.1));
    box.setRight(std::max(box.right(), point[0] + 0.1));
    box.setTop(std::min(box.top(), point[1] - 0.1));
    box.setBottom(std::max(box.bottom(), point[1] + 0.1));
  }
  return box;
}

void MapCanvas::fit() {
  fitted_ = true;
  view_.fit(content(), {kMargin, kMargin}, {kMargin, kLegendRoom});
  update();
}

QString MapCanvas::readoutText() const {
  if (!cursor_) return {};
  const QPointF m = view_.toMetres(*cursor_);
  QString text = tr("%1 m ahead   %2 m %3")
                     .arg(m.x(), 0, 'f', 2)
                     .arg(std::abs(m.y()), 0, 'f', 2)
                     .arg(m.y() >= 0 ? tr("left") : tr("right"));
  if (!floor_) return text;
  const GridGeometry& g = floor_->geometry;
  const int ix = static_cast<int>(std::floor((m.x() - double(g.x_min)) / double(g.cell_size)));
  const int iy = static_cast<int>(std::floor((m.y() - double(g.y_min)) / double(g.cell_size)));
  if (!g.contains(ix, iy)) return text;
  const std::size_t cell = g.index(ix, iy);
  text += "   " + QString::fromLatin1(className(floor_->classes[cell]));
  const double height = double(floor_->heights[cell]);
  const double deviation = double(floor_->deviations[cell]);
  if (std::isfinite(height)) text += tr("   height %1 cm").arg(height * 100.0, 0, 'f', 1);
  if (std::isfinite(deviation)) text += tr("   deviation %1 mm").arg(deviation * 1000.0, 0, 'f', 1);
  return text;
}

QPainterPath MapCanvas::cone() const {
  const CameraPose pose = camera_.value_or(
      CameraPose{robot_.camera.x, robot_.camera.y, robot_.camera.yaw_deg * kRadians});
  const double length =
      floor_
          ? std::max(0.5, double(floor_->geometry.x_min) +
                              double(floor_->geometry.cell_size) * floor_->geometry.size_x - pose.x)
          : kConeLength;
  QPainterPath cone(view_.toPixel(pose.x, pose.y));
  constexpr int kSteps = 24;
  for (int i = 0; i <= kSteps; ++i) {
    const double angle = pose.yaw + half_angle_ * (2.0 * i / kSteps - 1.0);
    cone.lineTo(
        view_.toPixel(pose.x + length * std::cos(angle), pose.y + length * std::sin(angle)));
  }
  cone.closeSubpath();
  return cone;
}

void MapCanvas::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), theme::kWindow);
  paintGrid(painter, view_, size());
  // The view of the camera is filled below the cells, so that these keep their colours, and
  // outlined above.
  const QPainterPath seen = cone();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.fillPath(seen, QColor(0x5a, 0xb4, 0xff, 22));
  if (floor_) paintFloor(painter, view_, *floor_, judged_);
  paintWay(painter, view_, outline_, drive_);
  paintRangers(painter, view_, drive_.rangers);
  if (objects_ && judged_) {
    paintJudgedObjects(painter, view_, *objects_, band_);
  } else if (objects_ && floor_) {
    paintObjects(painter, view_, *objects_);
  }
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(QColor(0x5a, 0xb4, 0xff, 130), 1));
  painter.setBrush(Qt::NoBrush);
  painter.drawPath(seen);
  paintRings(painter, view_, size());
  paintRobot(painter, view_, robot_);
  paintCause(painter, view_, drive_);
  const double margin = theme::kSpace;
  if (floor_ && freshness(state_) == Freshness::kStale) {
    paintStale(painter, rect(), state_);
  } else if (floor_ && !state_.rejection.empty()) {
    paintRejected(painter, rect(), state_.rejection);
  } else if (!floor_) {
    paintEmptyCard(painter, QRectF(0, 0, width(), height() * 0.7), words_);
  }
  paintLegend(painter, {margin, height() - margin}, width() - 130.0,
              {judged_, band_.has_value(), !drive_.rangers.empty()});
  paintScaleBar(painter, view_, {width() - margin, height() - margin});
  const QString text = readoutText();
  if (!text.isEmpty()) {
    paintPill(painter, {margin, margin}, Qt::AlignLeft | Qt::AlignTop, text, theme::kText);
  }
}

void MapCanvas::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  dragged_from_ = event->localPos();
  setCursor(Qt::ClosedHandCursor);
}

void MapCanvas::mouseMoveEvent(QMouseEvent* event) {
  cursor_ = event->localPos();
  if (event->buttons() & Qt::LeftButton) {
    const QPointF moved = event->localPos() - dragged_from_;
    dragged_from_ = event->localPos();
    panBy(moved);
  }
  update();
}

void MapCanvas::mouseReleaseEvent(QMouseEvent*) {
  unsetCursor();
}

void MapCanvas::mouseDoubleClickEvent(QMouseEvent*) {
  fit();
}

}  // namespace pilothouse::gui
