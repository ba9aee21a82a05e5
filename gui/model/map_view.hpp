#pragma once

#include <QPointF>
#include <QRectF>
#include <QSizeF>

namespace pilothouse::gui {

/// Where metres of a frame lie on a widget (pixels, x right, y down). Both ways are exact inverses.
class MapView {
 public:
  static constexpr double kLeastScale = 1.0;    ///< pixels a metre
  static constexpr double kMostScale = 4000.0;  ///< pixels a metre

  /// How the frame lies: of the robot (x forward, y left) forward is up and left is left; of the
  /// map x is right and y is up.
  enum class Axes { kForwardUp, kEastRight };

  explicit MapView(Axes axes = Axes::kForwardUp) : axes_(axes) {}
  /// The origin at pixel (0, 0), where a painter's transform puts it.
  static MapView about(Axes axes, double scale);

  QPointF toPixel(double x_m, double y_m) const;
  /// @return (x, y) in metres.
  QPointF toMetres(QPointF pixel) const;
  double scale() const { return scale_; }  ///< pixels a metre
  /// Scales by `factor` and keeps the place under `pixel` where it is.
  void zoomAbout(QPointF pixel, double factor);
  void panBy(QPointF pixels);
  /// Brings the place into the middle.
  void centreOn(QPointF metres) { centre_ = metres; }
  /// Keeps what is in the middle in the middle.
  void resize(QSizeF pixels) { size_ = pixels; }
  QSizeF size() const { return size_; }
  /// Shows all of the rectangle (x, y in metres) within the margins (pixels: left, top, right,
  /// bottom as x, y of the two points).
  void fit(QRectF metres, QPointF left_top, QPointF right_bottom);

 private:
  /// Pixels right and up for metres along x and y, without the scale.
  QPointF turned(QPointF metres) const;
  QPointF turnedBack(QPointF right_up) const;

  Axes axes_;
  QSizeF size_{1.0, 1.0};
  QPointF centre_{1.5, 0.0};  ///< metres in the middle of the widget
  double scale_ = 100.0;
};

/// A round length (1, 2 or 5 times a power of ten) of which one is at least `pixels` long [m].
double roundLength(double pixels, double pixels_per_metre);

}  // namespace pilothouse::gui
