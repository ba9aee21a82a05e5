#include "bench/grid_picture.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace pilothouse::bench {
namespace {

const cv::Scalar kPaper(250, 248, 246);
const cv::Scalar kInk(60, 50, 40);
constexpr int kTitle = 30;   // height of a title [pixel]
constexpr int kLegend = 24;  // height of a row of the legend [pixel]
constexpr int kGap = 12;

void write(cv::Mat& picture, const std::string& text, cv::Point at, double scale) {
  cv::putText(picture, text, at, cv::FONT_HERSHEY_SIMPLEX, scale, kInk, 1, cv::LINE_AA);
}

/// Writes the entries side by side, in two rows where one is too short.
void drawLegend(cv::Mat& picture, const std::vector<LegendEntry>& legend, int top) {
  int x = 4, y = top;
  for (const LegendEntry& entry : legend) {
    const int wide =
        18 + cv::getTextSize(entry.text, cv::FONT_HERSHEY_SIMPLEX, 0.42, 1, nullptr).width;
    if (x + wide > picture.cols) {
      x = 4;
      y += kLegend;
    }
    cv::rectangle(picture, cv::Rect(x, y + 6, 12, 12), entry.colour, cv::FILLED);
    write(picture, entry.text, {x + 17, y + 17}, 0.42);
    x += wide + 14;
  }
}

}  // namespace

cv::Scalar colourOf(CellClass c) {
  switch (c) {
    case CellClass::kUnknown:
      return {70, 66, 62};
    case CellClass::kFloor:
      return {120, 180, 110};
    case CellClass::kThreshold:
      return {60, 210, 245};
    case CellClass::kObstacle:
      return {60, 60, 220};
    case CellClass::kDropOff:
      return {200, 70, 160};
  }
  return {0, 0, 0};
}

std::vector<LegendEntry> classLegend() {
  return {{colourOf(CellClass::kUnknown), "unknown"},
          {colourOf(CellClass::kFloor), "floor"},
          {colourOf(CellClass::kThreshold), "threshold"},
          {colourOf(CellClass::kObstacle), "obstacle"},
          {colourOf(CellClass::kDropOff), "drop-off"}};
}

cv::Mat drawGrid(const GridGeometry& g, const std::vector<cv::Scalar>& colours, int pixels_a_cell) {
  const int s = pixels_a_cell;
  cv::Mat picture(g.size_x * s, g.size_y * s, CV_8UC3);
  for (int iy = 0; iy < g.size_y; ++iy) {
    for (int ix = 0; ix < g.size_x; ++ix) {
      const cv::Rect cell((g.size_y - 1 - iy) * s, (g.size_x - 1 - ix) * s, s, s);
      cv::rectangle(picture, cell, colours[g.index(ix, iy)], cv::FILLED);
    }
  }
  const auto x_max = static_cast<double>(g.x_min + g.cell_size * static_cast<float>(g.size_x));
  for (int metre = static_cast<int>(std::ceil(g.x_min)); metre < x_max; ++metre) {
    const int v = static_cast<int>((x_max - metre) / static_cast<double>(g.cell_size) * s);
    cv::line(picture, {0, v}, {picture.cols, v}, {150, 150, 150}, 1);
    cv::putText(picture, std::to_string(metre) + " m", {4, v - 4}, cv::FONT_HERSHEY_SIMPLEX, 0.4,
                {235, 235, 235}, 1, cv::LINE_AA);
  }
  const int middle = picture.cols / 2;
  const std::vector<cv::Point> arrow = {
      {middle, picture.rows - 14}, {middle - 8, picture.rows - 1}, {middle + 8, picture.rows - 1}};
  cv::fillConvexPoly(picture, arrow, {255, 255, 255}, cv::LINE_AA);
  return picture;
}

cv::Mat drawClasses(const GridGeometry& geometry, const std::vector<CellClass>& classes,
                    int pixels_a_cell) {
  std::vector<cv::Scalar> colours(classes.size());
  std::transform(classes.begin(), classes.end(), colours.begin(), colourOf);
  return drawGrid(geometry, colours, pixels_a_cell);
}

cv::Mat drawDepth(const cv::Mat& millimetres, double farthest) {
  cv::Mat grey, coloured;
  millimetres.convertTo(grey, CV_8UC1, -255.0 / (farthest * 1000.0), 255.0);
  cv::applyColorMap(grey, coloured, cv::COLORMAP_JET);
  coloured.setTo(cv::Scalar(0, 0, 0), millimetres == 0);
  return coloured;
}

cv::Mat panel(const cv::Mat& picture, const std::string& title, cv::Size size,
              const std::vector<LegendEntry>& legend) {
  cv::Mat panel(size.height + kTitle + 2 * kLegend, size.width, CV_8UC3, kPaper);
  write(panel, title, {2, kTitle - 9}, 0.55);
  const double scale = std::min(static_cast<double>(size.width) / picture.cols,
                                static_cast<double>(size.height) / picture.rows);
  cv::Mat scaled;
  cv::resize(picture, scaled, {}, scale, scale, scale < 1.0 ? cv::INTER_AREA : cv::INTER_NEAREST);
  scaled.copyTo(panel(cv::Rect(0, kTitle, scaled.cols, scaled.rows)));
  drawLegend(panel, legend, kTitle + scaled.rows + 2);
  return panel;
}

cv::Mat sheet(const std::vector<cv::Mat>& panels, int columns, const std::string& headline) {
  const cv::Size one = panels.front().size();
  const int rows = (static_cast<int>(panels.size()) + columns - 1) / columns;
  cv::Mat sheet(40 + rows * (one.height + kGap), kGap + columns * (one.width + kGap), CV_8UC3,
                kPaper);
  const int wide = cv::getTextSize(headline, cv::FONT_HERSHEY_SIMPLEX, 0.65, 1, nullptr).width;
  const double room = static_cast<double>(sheet.cols - 2 * kGap) / std::max(1, wide);
  write(sheet, headline, {kGap, 27}, 0.65 * std::min(1.0, room));
  for (int i = 0; i < static_cast<int>(panels.size()); ++i) {
    const cv::Point at(kGap + i % columns * (one.width + kGap),
                       40 + i / columns * (one.height + kGap));
    panels[static_cast<std::size_t>(i)].copyTo(sheet(cv::Rect(at, one)));
  }
  return sheet;
}

}  // namespace pilothouse::bench
