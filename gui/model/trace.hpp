#pragma once

#include <cstddef>
#include <vector>

namespace pilothouse::gui {

/// A point of a curve; a NaN value breaks it.
struct CurvePoint {
  double t, value;
};

/// The last samples of one quantity. Bounded: the oldest go first. Times are steady seconds and
/// never go back (a sample that does is dropped).
class Trace {
 public:
  static constexpr std::size_t kCapacity = 8192;  ///< two minutes at 60 Hz
  static constexpr double kGap = 0.6;             ///< a longer silence breaks the curve [s]

  /// @param value NaN or infinite: nothing is known or there is none; the curve has a gap.
  void add(double t, double value);
  std::size_t size() const { return samples_.size(); }
  /// The curve between two times with one sample beyond each end, as at most 4 points in each of
  /// `columns` equal parts, so that every spike stays to be seen.
  void curve(double from, double to, int columns, std::vector<CurvePoint>& out) const;
  /// The sample nearest before `t`, unless it is older than a gap; NaN: none.
  double at(double t) const;

 private:
  const CurvePoint& sample(std::size_t i) const { return samples_[(first_ + i) % samples_.size()]; }
  std::size_t firstAfter(double t) const;

  std::vector<CurvePoint> samples_;
  std::size_t first_ = 0;  ///< place of the oldest once the ring is full
};

}  // namespace pilothouse::gui
