#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace pilothouse::bench {

/// Colours are blue, green, red as OpenCV has them.
namespace ink {
const cv::Scalar kPaper(255, 255, 255), kText(45, 38, 33), kPale(150, 142, 136),
    kGrid(232, 228, 224);
const cv::Scalar kRed(48, 40, 200), kOrange(20, 130, 240), kBlue(190, 110, 40), kGreen(80, 150, 60);
}  // namespace ink

/// A picture to draw on in its own pixels, drawn twice as large and reduced at the end, so that
/// lines and letters are smooth.
class FigureCanvas {
 public:
  enum class Anchor { kLeft, kMiddle, kRight };

  FigureCanvas(int width, int height);
  int width() const { return picture_.cols / kScale; }
  int height() const { return picture_.rows / kScale; }

  void text(cv::Point2d at, const std::string& words, double pixels, const cv::Scalar& colour,
            Anchor anchor = Anchor::kLeft, bool bold = false);
  static double textWidth(const std::string& words, double pixels);
  void line(cv::Point2d from, cv::Point2d to, const cv::Scalar& colour, double width = 1.0);
  void polyline(const std::vector<cv::Point2d>& points, const cv::Scalar& colour,
                double width = 1.0, bool closed = false);
  void dashed(const std::vector<cv::Point2d>& points, const cv::Scalar& colour, double width,
              double dash);
  void disc(cv::Point2d centre, double radius, const cv::Scalar& colour, bool filled = true,
            double width = 1.0);
  /// @param opacity 0..1
  void fill(const std::vector<cv::Point2d>& corners, const cv::Scalar& colour,
            double opacity = 1.0);
  void fill(const cv::Rect2d& box, const cv::Scalar& colour, double opacity = 1.0);
  void frame(const cv::Rect2d& box, const cv::Scalar& colour, double width = 1.0);
  /// A picture scaled into the box. @param smooth false: each of its pixels stays a rectangle.
  void picture(const cv::Mat& picture, const cv::Rect2d& box, bool smooth);
  /// Draws only within the box from now on; an empty one: everywhere.
  void clip(const cv::Rect2d& box);
  cv::Mat finished() const;

 private:
  static constexpr int kScale = 2;
  static cv::Point place(cv::Point2d point);
  cv::Mat& target() { return view_; }
  cv::Point shifted(cv::Point2d point) const;

  cv::Mat picture_, view_;
  cv::Point origin_{0, 0};
};

}  // namespace pilothouse::bench
