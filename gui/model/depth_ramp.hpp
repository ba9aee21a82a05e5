#pragma once

#include <QColor>
#include <vector>

namespace pilothouse::gui {

/// Metres at the two ends of the colour ramp.
struct DepthSpan {
  float near_m = 0.0F;
  float far_m = 4.0F;
};

/// The viridis ramp (van der Walt and Smith, 2015; public domain): even steps to the eye, and in
/// order for every kind of colour blindness and in grey. Bright yellow is near, dark violet far.
class DepthRamp {
 public:
  DepthRamp();
  /// Colour of a distance; what lies beyond an end takes its colour. Where nothing was measured
  /// (not > 0): nothing().
  QRgb colour(float metres, DepthSpan span) const {
    if (!(metres > 0.0F)) return nothing();
    const float t = (metres - span.near_m) / (span.far_m - span.near_m) * 255.0F + 0.5F;
    return table_[t <= 0.0F ? 0U : t >= 255.0F ? 255U : static_cast<unsigned>(t)];
  }
  /// The distance that a colour of the ramp stands for [m]; 0 for nothing().
  float metres(QRgb colour, DepthSpan span) const;
  static QRgb nothing() { return qRgb(10, 11, 13); }

 private:
  std::vector<QRgb> table_;  ///< 256 colours, the nearest first
};

/// Chooses the span from the pictures without flicker: widens at once, narrows only when a second
/// of pictures asks for it.
class DepthSpanChooser {
 public:
  /// @param metres one picture, 0: no measurement. @return the span to use for it.
  DepthSpan update(const std::vector<float>& metres);

 private:
  DepthSpan span_{0.0F, 1.0F};
  int narrower_ = 0;
  bool first_ = true;
};

}  // namespace pilothouse::gui
