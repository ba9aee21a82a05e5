#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "core/floor/floor_cells.hpp"

namespace pilothouse::bench {

/// Colours are blue, green, red as OpenCV has them.
struct LegendEntry {
  cv::Scalar colour;
  std::string text;
};

cv::Scalar colourOf(CellClass c);
/// The classes of the floor grid with their colours.
std::vector<LegendEntry> classLegend();

/// The grid from above, forward is up and left is left; metre lines and the robot's place.
/// @param colours one a cell
cv::Mat drawGrid(const GridGeometry& geometry, const std::vector<cv::Scalar>& colours,
                 int pixels_a_cell);
cv::Mat drawClasses(const GridGeometry& geometry, const std::vector<CellClass>& classes,
                    int pixels_a_cell);
/// 16-bit depth [mm] in false colour, near is red and `farthest` [m] blue; nothing measured: black.
cv::Mat drawDepth(const cv::Mat& millimetres, double farthest);

/// The picture with a title above it, scaled to `size`.
cv::Mat panel(const cv::Mat& picture, const std::string& title, cv::Size size,
              const std::vector<LegendEntry>& legend = {});
/// Panels of one size in rows of `columns`, with a headline.
cv::Mat sheet(const std::vector<cv::Mat>& panels, int columns, const std::string& headline);

}  // namespace pilothouse::bench
