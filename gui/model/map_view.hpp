#pragma once

#include <QPointF>
#include <QRectF>
#include <QSizeF>

namespace pilothouse::gui {

/// Where metres of the base frame (x forward, y left) lie on the map's widget (pixels, x right, y
/// down): forward is up, left is left. Both ways are exact inverses.
class MapView {
 public:
  static constexpr double kLeastScale = 4.0;    ///< pixels a metre
  static constexpr double kMostScale = 4000.0;  ///< pixels a metre

  QPointF toPixel(double x_m, double y_m) const;
  /// @return (x, y) in metres.
  QPointF toMetres(QPointF pixel) const;
  double scale() const { return scale_; }  ///< pixels a metre
  /// Scales by `factor` and keeps the place under `pixel` where it is.
  void zoomAbout(QPointF pixel, double factor);
  void panBy(QPointF pixels);
  /// Keeps what is in the middle in the middle.
  void resize(QSizeF pixels) { size_ = pixels; }
  /// Shows all of the rectangle (x, y in metres) within the margins (pixels: left, top, right,
  /// bottom as x, y of the two points).
  void fit(QRectF metres, QPointF left_top, QPointF right_bottom);

 private:
  QSizeF size_{1.0, 1.0};
  QPointF centre_{1.5, 0.0};  ///< metres in the middle of the widget
  double scale_ = 100.0;
};

/// A round length (1, 2 or 5 times a power of ten) of which one is at least `pixels` long [m].
double roundLength(double pixels, double pixels_per_metre);

}  // namespace pilothouse::gui
