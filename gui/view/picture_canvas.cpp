#include "gui/view/picture_canvas.hpp"

#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>

#include "gui/view/theme.hpp"

namespace pilothouse::gui {

PictureCanvas::PictureCanvas(QWidget* parent) : QWidget(parent) {
  setMouseTracking(true);
  setMinimumSize(140, 70);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
  setAttribute(Qt::WA_OpaquePaintEvent);
}

void PictureCanvas::setPicture(const QImage& image) {
  image_ = image;
  update();
}

void PictureCanvas::setState(const FeedState& state, const EmptyWords& words) {
  state_ = state;
  words_ = words;
  update();
}

void PictureCanvas::setLegend(int width, std::function<void(QPainter&, const QRectF&)> paint) {
  legend_width_ = width;
  legend_ = std::move(paint);
}

QRectF PictureCanvas::pictureRect() const {
  if (image_.isNull()) return {};
  const double room_x = std::max(1, width() - legend_width_);
  const double factor = std::min(room_x / image_.width(), double(height()) / image_.height());
  const double wide = image_.width() * factor;
  const double high = image_.height() * factor;
  return {(room_x - wide) / 2, (height() - high) / 2, wide, high};
}

std::optional<QPoint> PictureCanvas::pixelAt(QPointF place) const {
  const QRectF where = pictureRect();
  if (!where.contains(place) || where.isEmpty()) return std::nullopt;
  const double column = (place.x() - where.left()) / where.width() * image_.width();
  const double row = (place.y() - where.top()) / where.height() * image_.height();
  return QPoint(std::min(static_cast<int>(column), image_.width() - 1),
                std::min(static_cast<int>(row), image_.height() - 1));
}

QString PictureCanvas::readoutText() const {
  if (!cursor_ || !readout_) return {};
  const auto pixel = pixelAt(*cursor_);
  return pixel ? readout_(*pixel) : QString();
}

void PictureCanvas::paintCursor(QPainter& painter, const QRectF& where) {
  const QString text = readoutText();
  if (text.isEmpty()) return;
  const QPointF at(std::floor(cursor_->x()) + 0.5, std::floor(cursor_->y()) + 0.5);
  for (const auto& pen : {QPen(QColor(0, 0, 0, 170), 3), QPen(Qt::white, 1)}) {
    painter.setPen(pen);
    painter.drawLine(at + QPointF(-9, 0), at + QPointF(-3, 0));
    painter.drawLine(at + QPointF(3, 0), at + QPointF(9, 0));
    painter.drawLine(at + QPointF(0, -9), at + QPointF(0, -3));
    painter.drawLine(at + QPointF(0, 3), at + QPointF(0, 9));
  }
  const double margin = theme::kSpace;
  paintPill(painter, {where.left() + margin, where.bottom() - margin},
            Qt::AlignLeft | Qt::AlignBottom, text, theme::kText);
}

void PictureCanvas::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), theme::kPanel);
  if (image_.isNull()) {
    paintEmpty(painter, rect(), words_);
    return;
  }
  const QRectF where = pictureRect();
  // Smooth only when the picture shrinks: enlarged depth must show its true pixels.
  painter.setRenderHint(QPainter::SmoothPixmapTransform, where.width() < image_.width());
  painter.drawImage(where, image_);
  if (legend_) {
    legend_(painter, QRectF(where.right(), where.top(), legend_width_, where.height()));
  }
  if (freshness(state_) == Freshness::kStale) {
    paintStale(painter, where, state_);
  } else if (!state_.rejection.empty()) {
    paintRejected(painter, where, state_.rejection);
  }
  paintCursor(painter, where);
}

void PictureCanvas::mouseMoveEvent(QMouseEvent* event) {
  cursor_ = event->localPos();
  update();
}

void PictureCanvas::leaveEvent(QEvent*) {
  cursor_.reset();
  update();
}

}  // namespace pilothouse::gui
