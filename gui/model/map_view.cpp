#include "gui/model/map_view.hpp"

#include <algorithm>
#include <cmath>

namespace pilothouse::gui {

MapView MapView::about(Axes axes, double scale) {
  MapView view(axes);
  view.size_ = {0.0, 0.0};
  view.centre_ = {0.0, 0.0};
  view.scale_ = scale;
  return view;
}

QPointF MapView::turned(QPointF metres) const {
  return axes_ == Axes::kForwardUp ? QPointF(-metres.y(), metres.x()) : metres;
}

QPointF MapView::turnedBack(QPointF right_up) const {
  return axes_ == Axes::kForwardUp ? QPointF(right_up.y(), -right_up.x()) : right_up;
}

QPointF MapView::toPixel(double x_m, double y_m) const {
  const QPointF off = turned(QPointF(x_m, y_m) - centre_);
  return {size_.width() * 0.5 + off.x() * scale_, size_.height() * 0.5 - off.y() * scale_};
}

QPointF MapView::toMetres(QPointF pixel) const {
  return centre_ + turnedBack({(pixel.x() - size_.width() * 0.5) / scale_,
                               (size_.height() * 0.5 - pixel.y()) / scale_});
}

void MapView::zoomAbout(QPointF pixel, double factor) {
  if (!(factor > 0.0)) return;
  const QPointF before = toMetres(pixel);
  scale_ = std::clamp(scale_ * factor, kLeastScale, kMostScale);
  centre_ += before - toMetres(pixel);
}

void MapView::panBy(QPointF pixels) {
  centre_ -= turnedBack({pixels.x() / scale_, -pixels.y() / scale_});
}

void MapView::fit(QRectF metres, QPointF left_top, QPointF right_bottom) {
  const double room_x = std::max(20.0, size_.width() - left_top.x() - right_bottom.x());
  const double room_y = std::max(20.0, size_.height() - left_top.y() - right_bottom.y());
  const bool forward_up = axes_ == Axes::kForwardUp;
  const double wide = forward_up ? metres.height() : metres.width();
  const double high = forward_up ? metres.width() : metres.height();
  scale_ = std::clamp(std::min(room_y / std::max(0.1, high), room_x / std::max(0.1, wide)),
                      kLeastScale, kMostScale);
  const QPointF off((right_bottom.x() - left_top.x()) * 0.5,
                    (right_bottom.y() - left_top.y()) * 0.5);
  centre_ = metres.center() + turnedBack({off.x() / scale_, -off.y() / scale_});
}

double roundLength(double pixels, double pixels_per_metre) {
  const double least = pixels / pixels_per_metre;
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double digit : {1.0, 2.0, 5.0}) {
    if (digit * power >= least) return digit * power;
  }
  return 10.0 * power;
}

}  // namespace pilothouse::gui
