#include "gui/view/movable_canvas.hpp"

#include <QWheelEvent>
#include <cmath>

namespace pilothouse::gui {

namespace {
constexpr double kKeyZoom = 1.25, kWheelZoom = 1.0015;  // a key, an eighth of a degree
}  // namespace

MovableCanvas::MovableCanvas(MapView::Axes axes, QWidget* parent) : QWidget(parent), view_(axes) {
  setFocusPolicy(Qt::ClickFocus);  // takes the keys back from a field
  setMouseTracking(true);
  setMinimumSize(200, 160);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
  setAttribute(Qt::WA_OpaquePaintEvent);
}

void MovableCanvas::zoom(QPointF about, double factor) {
  fitted_ = false;
  view_.zoomAbout(zoomedAbout(about), factor);
  update();
}

void MovableCanvas::zoomIn() {
  zoom(middlePixel(), kKeyZoom);
}

void MovableCanvas::zoomOut() {
  zoom(middlePixel(), 1.0 / kKeyZoom);
}

void MovableCanvas::pan(QPoint pixels) {
  panBy(pixels);
}

void MovableCanvas::panBy(QPointF pixels) {
  if (pixels.isNull()) return;
  fitted_ = false;
  dragged();
  view_.panBy(pixels);
  update();
}

void MovableCanvas::resizeEvent(QResizeEvent*) {
  view_.resize(size());
  if (fitted_) fit();
}

void MovableCanvas::wheelEvent(QWheelEvent* event) {
#if QT_VERSION >= QT_VERSION_CHECK(5, 14, 0)
  const QPointF place = event->position();
#else
  const QPointF place = event->posF();
#endif
  zoom(place, std::pow(kWheelZoom, event->angleDelta().y()));
  event->accept();
}

void MovableCanvas::leaveEvent(QEvent*) {
  cursor_.reset();
  update();
}

}  // namespace pilothouse::gui
