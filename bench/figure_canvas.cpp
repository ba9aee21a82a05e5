#include "bench/figure_canvas.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace pilothouse::bench {
namespace {

constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
constexpr double kLetter = 22.0;  // height of the font at scale 1 [pixel]
constexpr int kBits = 4;          // of sub-pixel places

int strokeOf(double width, int scale) {
  return std::max(1, static_cast<int>(std::lround(width * scale)));
}

}  // namespace

FigureCanvas::FigureCanvas(int width, int height)
    : picture_(height * kScale, width * kScale, CV_8UC3, ink::kPaper), view_(picture_) {}

cv::Point FigureCanvas::place(cv::Point2d point) {
  constexpr double kFine = kScale * (1 << kBits);
  const auto bounded = [](double v) { return static_cast<int>(std::clamp(v, -1e6, 1e6)); };
  return {bounded(point.x * kFine), bounded(point.y * kFine)};
}

cv::Point FigureCanvas::shifted(cv::Point2d point) const {
  return place(point) - origin_ * (1 << kBits);
}

void FigureCanvas::clip(const cv::Rect2d& box) {
  const cv::Rect all(0, 0, picture_.cols, picture_.rows);
  const cv::Rect wanted(static_cast<int>(box.x * kScale), static_cast<int>(box.y * kScale),
                        static_cast<int>(box.width * kScale),
                        static_cast<int>(box.height * kScale));
  const cv::Rect used = box.empty() ? all : wanted & all;
  view_ = picture_(used);
  origin_ = used.tl();
}

double FigureCanvas::textWidth(const std::string& words, double pixels) {
  return cv::getTextSize(words, kFont, 1.0, 1, nullptr).width * pixels / kLetter;
}

void FigureCanvas::text(cv::Point2d at, const std::string& words, double pixels,
                        const cv::Scalar& colour, Anchor anchor, bool bold) {
  const double wide = textWidth(words, pixels);
  if (anchor == Anchor::kMiddle) at.x -= 0.5 * wide;
  if (anchor == Anchor::kRight) at.x -= wide;
  const cv::Point where(static_cast<int>(at.x * kScale), static_cast<int>(at.y * kScale));
  cv::putText(view_, words, where - origin_, kFont, pixels / kLetter * kScale, colour, bold ? 4 : 2,
              cv::LINE_AA);
}

void FigureCanvas::line(cv::Point2d from, cv::Point2d to, const cv::Scalar& colour, double width) {
  cv::line(view_, shifted(from), shifted(to), colour, strokeOf(width, kScale), cv::LINE_AA, kBits);
}

void FigureCanvas::polyline(const std::vector<cv::Point2d>& points, const cv::Scalar& colour,
                            double width, bool closed) {
  std::vector<cv::Point> places;
  for (const auto& point : points) places.push_back(shifted(point));
  if (places.size() < 2) return;
  cv::polylines(view_, places, closed, colour, strokeOf(width, kScale), cv::LINE_AA, kBits);
}

void FigureCanvas::dashed(const std::vector<cv::Point2d>& points, const cv::Scalar& colour,
                          double width, double dash) {
  double along = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const cv::Point2d leg = points[i] - points[i - 1];
    const double length = std::hypot(leg.x, leg.y);
    for (double at = 0.0; at < length;) {
      const double phase = std::fmod(along + at, 2.0 * dash);
      const bool drawn = phase < dash;
      const double step = std::min(length - at, (drawn ? dash : 2.0 * dash) - phase + 1e-6);
      if (drawn) {
        line(points[i - 1] + leg * (at / length), points[i - 1] + leg * ((at + step) / length),
             colour, width);
      }
      at += step;
    }
    along += length;
  }
}

void FigureCanvas::disc(cv::Point2d centre, double radius, const cv::Scalar& colour, bool filled,
                        double width) {
  const int r = std::max(1, static_cast<int>(radius * kScale * (1 << kBits)));
  cv::circle(view_, shifted(centre), r, colour, filled ? cv::FILLED : strokeOf(width, kScale),
             cv::LINE_AA, kBits);
}

void FigureCanvas::fill(const std::vector<cv::Point2d>& corners, const cv::Scalar& colour,
                        double opacity) {
  std::vector<cv::Point> places;
  for (const auto& corner : corners) places.push_back(shifted(corner));
  if (opacity >= 1.0) {
    cv::fillPoly(view_, std::vector{places}, colour, cv::LINE_AA, kBits);
    return;
  }
  cv::Mat over = view_.clone();
  cv::fillPoly(over, std::vector{places}, colour, cv::LINE_AA, kBits);
  cv::addWeighted(over, opacity, view_, 1.0 - opacity, 0.0, view_);
}

void FigureCanvas::fill(const cv::Rect2d& box, const cv::Scalar& colour, double opacity) {
  const cv::Point2d across(box.width, 0.0), down(0.0, box.height);
  fill({box.tl(), box.tl() + across, box.br(), box.tl() + down}, colour, opacity);
}

void FigureCanvas::frame(const cv::Rect2d& box, const cv::Scalar& colour, double width) {
  const cv::Point2d across(box.width, 0.0), down(0.0, box.height);
  polyline({box.tl(), box.tl() + across, box.br(), box.tl() + down}, colour, width, true);
}

void FigureCanvas::picture(const cv::Mat& picture, const cv::Rect2d& box, bool smooth) {
  const cv::Rect where(static_cast<int>(box.x * kScale), static_cast<int>(box.y * kScale),
                       static_cast<int>(box.width * kScale), static_cast<int>(box.height * kScale));
  cv::resize(picture, picture_(where), where.size(), 0.0, 0.0,
             smooth ? cv::INTER_AREA : cv::INTER_NEAREST);
}

cv::Mat FigureCanvas::finished() const {
  cv::Mat reduced;
  cv::resize(picture_, reduced, {}, 1.0 / kScale, 1.0 / kScale, cv::INTER_AREA);
  return reduced;
}

}  // namespace pilothouse::bench
