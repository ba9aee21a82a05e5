#include "bench/point_picture.hpp"

#include <cmath>

#include "bench/grid_picture.hpp"

namespace pilothouse::bench {
namespace {

std::uint16_t millimetres(float metres) {
  return metres > 0.0F && metres < 60.0F ? static_cast<std::uint16_t>(metres * 1000.0F + 0.5F)
                                         : std::uint16_t{0};
}

template <class View, class DepthAt>
cv::Mat fill(const View& view, DepthAt depth_at) {
  cv::Mat depth(static_cast<int>(view.height()), static_cast<int>(view.width()), CV_16UC1);
  for (std::uint32_t row = 0; row < view.height(); ++row) {
    for (std::uint32_t col = 0; col < view.width(); ++col) {
      depth.at<std::uint16_t>(static_cast<int>(row), static_cast<int>(col)) =
          millimetres(depth_at(row, col));
    }
  }
  return depth;
}

}  // namespace

cv::Mat depthOf(const CloudView& cloud) {
  return fill(cloud,
              [&](std::uint32_t row, std::uint32_t col) { return cloud.point(row, col).z(); });
}

cv::Mat depthOf(const DepthView& depth) {
  return fill(depth, [&](std::uint32_t row, std::uint32_t col) { return depth.metres(row, col); });
}

cv::Mat tint(const cv::Mat& picture, const std::vector<CellClass>& classes) {
  cv::Mat tinted = picture.clone();
  for (int row = 0; row < tinted.rows; ++row) {
    for (int col = 0; col < tinted.cols; ++col) {
      const CellClass c = classes[static_cast<std::size_t>(row * tinted.cols + col)];
      if (c == CellClass::kUnknown) continue;
      const cv::Scalar colour = colourOf(c);
      cv::Vec3b& pixel = tinted.at<cv::Vec3b>(row, col);
      for (int i = 0; i < 3; ++i) {
        pixel[i] = static_cast<std::uint8_t>(0.5 * pixel[i] + 0.5 * colour[i]);
      }
    }
  }
  return tinted;
}

}  // namespace pilothouse::bench
