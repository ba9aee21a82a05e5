#include "gui/model/trace.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pilothouse::gui {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// The samples of one column: first, lowest, highest and last, in the order of time.
class Column {
 public:
  void add(const CurvePoint& p) {
    if (count_++ == 0) {
      first_ = lowest_ = highest_ = p;
    }
    if (p.value < lowest_.value) lowest_ = p;
    if (p.value > highest_.value) highest_ = p;
    last_ = p;
  }
  void flush(std::vector<CurvePoint>& out) {
    if (count_ == 0) return;
    out.push_back(first_);
    const auto& early = lowest_.t <= highest_.t ? lowest_ : highest_;
    const auto& late = lowest_.t <= highest_.t ? highest_ : lowest_;
    if (early.t > first_.t) out.push_back(early);
    if (late.t > early.t) out.push_back(late);
    if (last_.t > late.t) out.push_back(last_);
    count_ = 0;
  }

 private:
  std::size_t count_ = 0;
  CurvePoint first_{}, lowest_{}, highest_{}, last_{};
};

}  // namespace

void Trace::add(double t, double value) {
  if (!std::isfinite(t)) return;
  if (!samples_.empty() && t < sample(samples_.size() - 1).t) return;
  if (!std::isfinite(value)) value = kNone;
  if (samples_.size() < kCapacity) {
    samples_.push_back({t, value});
  } else {
    samples_[first_] = {t, value};
    first_ = (first_ + 1) % kCapacity;
  }
}

std::size_t Trace::firstAfter(double t) const {
  std::size_t low = 0, high = samples_.size();
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    if (sample(middle).t <= t) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  return low;
}

double Trace::at(double t) const {
  const std::size_t after = firstAfter(t);
  if (after == 0) return kNone;
  const CurvePoint& p = sample(after - 1);
  return t - p.t <= kGap ? p.value : kNone;
}

void Trace::curve(double from, double to, int columns, std::vector<CurvePoint>& out) const {
  out.clear();
  if (samples_.empty() || !(to > from) || columns < 1) return;
  const std::size_t after = firstAfter(from);
  const std::size_t begin = after > 0 ? after - 1 : 0;
  const std::size_t end = std::min(samples_.size(), firstAfter(to) + 1);
  const double width = (to - from) / columns;
  Column column;
  double number = -1e300;  // of the column
  double before = sample(begin).t;
  for (std::size_t i = begin; i < end; ++i) {
    const CurvePoint& p = sample(i);
    const bool breaks = std::isnan(p.value) || p.t - before > kGap;
    const double here = std::floor((p.t - from) / width);
    if (breaks || here > number) column.flush(out);
    number = here;
    if (breaks) out.push_back({p.t, kNone});
    if (!std::isnan(p.value)) column.add(p);
    before = p.t;
  }
  column.flush(out);
}

}  // namespace pilothouse::gui
