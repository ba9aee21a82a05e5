#include "bench/drive_chart.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

namespace pilothouse::bench {
namespace {

using Anchor = FigureCanvas::Anchor;

struct Cause {
  LimitCause cause;
  const char* name;
  cv::Scalar colour;
};
const Cause kCauses[] = {
    {LimitCause::kFree, "free", {205, 225, 205}},
    {LimitCause::kObstacle, "in the way", ink::kRed},
    {LimitCause::kBraking, "braking distance", {40, 30, 120}},
    {LimitCause::kPotential, "beside the way", ink::kOrange},
    {LimitCause::kThreshold, "threshold", {60, 200, 235}},
    {LimitCause::kUnseen, "not looked at", {150, 140, 130}},
    {LimitCause::kStale, "input too old", {0, 0, 0}},
};

const Cause& causeOf(LimitCause cause) {
  for (const auto& known : kCauses) {
    if (known.cause == cause) return known;
  }
  return kCauses[0];
}

std::string number(double value, const char* format) {
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

/// A part of the chart with axes of its own.
class Plot {
 public:
  Plot(FigureCanvas& canvas, const cv::Rect2d& box, double t0, double t1, double top)
      : canvas_(canvas), box_(box), t0_(t0), t1_(std::max(t1, t0 + 0.1)), top_(top) {}

  double x(double time) const { return box_.x + (time - t0_) / (t1_ - t0_) * box_.width; }
  double y(double value) const {
    return box_.br().y - std::clamp(value, 0.0, top_) / top_ * box_.height;
  }
  void axes(double step, const char* format, const std::string& label) {
    for (double v = 0.0; v <= top_ + 1e-9; v += step) {
      canvas_.line({box_.x, y(v)}, {box_.br().x, y(v)}, ink::kGrid);
      canvas_.text({box_.x - 8, y(v) + 5}, number(v, format), 14, ink::kText, Anchor::kRight);
    }
    const double every = t1_ - t0_ > 24.0 ? 5.0 : t1_ - t0_ > 10.0 ? 2.0 : 1.0;
    for (double t = std::ceil(t0_ / every) * every; t <= t1_ + 1e-9; t += every) {
      canvas_.line({x(t), box_.y}, {x(t), box_.br().y}, ink::kGrid);
    }
    canvas_.frame(box_, ink::kPale);
    canvas_.text({box_.x, box_.y - 9}, label, 15, ink::kText);
  }
  void times() {
    const double every = t1_ - t0_ > 24.0 ? 5.0 : t1_ - t0_ > 10.0 ? 2.0 : 1.0;
    for (double t = std::ceil(t0_ / every) * every; t <= t1_ + 1e-9; t += every) {
      canvas_.text({x(t), box_.br().y + 19}, number(t, "%.0f"), 14, ink::kText, Anchor::kMiddle);
    }
    canvas_.text({box_.br().x, box_.br().y + 38}, "time [s]", 15, ink::kText, Anchor::kRight);
  }
  template <class Value>
  std::vector<cv::Point2d> curve(const DriveRecord& record, Value value) const {
    std::vector<cv::Point2d> points;
    for (const auto& sample : record.samples) points.emplace_back(x(sample.time), y(value(sample)));
    return points;
  }

 private:
  FigureCanvas& canvas_;
  cv::Rect2d box_;
  double t0_, t1_, top_;
};

double speedTop(const DriveRecord& record) {
  double most = 0.3;
  for (const auto& s : record.samples) most = std::max({most, s.wanted, s.measured});
  return std::ceil(most * 10.0 + 0.3) / 10.0;
}

void drawLegend(FigureCanvas& canvas, double right, double y) {
  struct Entry {
    const char* name;
    cv::Scalar colour;
    double width;
    bool dashed;
  };
  const Entry entries[] = {{"measured", ink::kText, 2.2, false},
                           {"limited command", ink::kBlue, 1.6, false},
                           {"limit", ink::kRed, 1.4, true},
                           {"wanted", ink::kPale, 1.6, false}};
  for (const auto& entry : entries) {
    right -= FigureCanvas::textWidth(entry.name, 14);
    canvas.text({right, y}, entry.name, 14, ink::kText);
    const std::vector<cv::Point2d> stroke = {{right - 36, y - 5}, {right - 8, y - 5}};
    if (entry.dashed) {
      canvas.dashed(stroke, entry.colour, entry.width, 5);
    } else {
      canvas.polyline(stroke, entry.colour, entry.width);
    }
    right -= 56;
  }
}

/// What limits, as a strip of colours with their names.
void drawCauses(FigureCanvas& canvas, const cv::Rect2d& strip, const Plot& plot,
                const DriveRecord& record) {
  std::set<LimitCause> met;
  const auto& samples = record.samples;
  for (std::size_t i = 0; i < samples.size();) {
    std::size_t end = i;
    while (end < samples.size() && samples[end].cause == samples[i].cause) ++end;
    const double from = plot.x(samples[i].time);
    const double to = plot.x(end < samples.size() ? samples[end].time : samples.back().time);
    canvas.fill(cv::Rect2d(from, strip.y, std::max(1.0, to - from), strip.height),
                causeOf(samples[i].cause).colour);
    met.insert(samples[i].cause);
    i = end;
  }
  double x = strip.x;
  canvas.text({x, strip.br().y + 19}, "limited by", 14, ink::kText);
  x += FigureCanvas::textWidth("limited by", 14) + 18;
  for (const auto& cause : kCauses) {
    if (met.count(cause.cause) == 0) continue;
    canvas.fill(cv::Rect2d(x, strip.br().y + 8, 13, 13), cause.colour);
    canvas.text({x + 19, strip.br().y + 19}, cause.name, 14, ink::kText);
    x += 19 + FigureCanvas::textWidth(cause.name, 14) + 24;
  }
}

}  // namespace

void drawDriveChart(FigureCanvas& canvas, const cv::Rect2d& box, const DriveRecord& record) {
  if (record.samples.empty()) return;
  const double t0 = record.samples.front().time, t1 = record.samples.back().time;
  const cv::Rect2d upper(box.x, box.y, box.width, box.height * 0.56);
  const cv::Rect2d strip(box.x, upper.br().y + 8, box.width, 12);
  const double lower_top = strip.br().y + 56;
  const cv::Rect2d lower(box.x, lower_top, box.width, box.br().y - lower_top);

  Plot speeds(canvas, upper, t0, t1, speedTop(record));
  speeds.axes(0.1, "%.1f", "speed along the path [m/s]");
  drawLegend(canvas, upper.br().x, upper.y - 9);
  const double moment = speeds.x(record.moment.time);
  canvas.dashed({{moment, upper.y}, {moment, lower.br().y}}, ink::kPale, 1.0, 4);
  const bool room = moment + 150 < upper.br().x;
  canvas.text({moment + (room ? 5 : -5), upper.y + 16}, "moment shown above", 13, ink::kPale,
              room ? Anchor::kLeft : Anchor::kRight);
  const auto top = speedTop(record);
  canvas.polyline(speeds.curve(record, [](const auto& s) { return s.wanted; }), ink::kPale, 1.6);
  canvas.dashed(speeds.curve(record, [&](const auto& s) { return std::min(s.limit, top); }),
                ink::kRed, 1.4, 5);
  canvas.polyline(speeds.curve(record, [](const auto& s) { return s.limited; }), ink::kBlue, 1.6);
  canvas.polyline(speeds.curve(record, [](const auto& s) { return s.measured; }), ink::kText, 2.2);
  drawCauses(canvas, strip, speeds, record);

  Plot ways(canvas, lower, t0, t1, 3.0);
  ways.axes(1.0, "%.0f",
            "free way [m] to what is in the way (red), beside it (orange); 3: none nearer");
  ways.times();
  canvas.polyline(ways.curve(record, [](const auto& s) { return s.potential_distance; }),
                  ink::kOrange, 1.4);
  canvas.polyline(ways.curve(record, [](const auto& s) { return s.obstacle_distance; }), ink::kRed,
                  1.8);
}

}  // namespace pilothouse::bench
