#include "gui/model/map_view.hpp"

#include <algorithm>
#include <cmath>

namespace pilothouse::gui {

QPointF MapView::toPixel(double x_m, double y_m) const {
  return {size_.width() * 0.5 - (y_m - centre_.y()) * scale_,
          size_.height() * 0.5 - (x_m - centre_.x()) * scale_};
}

QPointF MapView::toMetres(QPointF pixel) const {
  return {centre_.x() - (pixel.y() - size_.height() * 0.5) / scale_,
          centre_.y() - (pixel.x() - size_.width() * 0.5) / scale_};
}

void MapView::zoomAbout(QPointF pixel, double factor) {
  if (!(factor > 0.0)) return;
  const QPointF before = toMetres(pixel);
  scale_ = std::clamp(scale_ * factor, kLeastScale, kMostScale);
  centre_ += before - toMetres(pixel);
}

void MapView::panBy(QPointF pixels) {
  centre_ += QPointF(pixels.y(), pixels.x()) / scale_;
}

void MapView::fit(QRectF metres, QPointF left_top, QPointF right_bottom) {
  const double room_x = std::max(20.0, size_.width() - left_top.x() - right_bottom.x());
  const double room_y = std::max(20.0, size_.height() - left_top.y() - right_bottom.y());
  // x of the base frame runs up the widget, y across it.
  scale_ = std::clamp(
      std::min(room_y / std::max(0.1, metres.width()), room_x / std::max(0.1, metres.height())),
      kLeastScale, kMostScale);
  const QPointF off((right_bottom.x() - left_top.x()) * 0.5,
                    (right_bottom.y() - left_top.y()) * 0.5);
  centre_ = metres.center() - QPointF(off.y(), off.x()) / scale_;
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
