#include "gui/model/depth_ramp.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <opencv2/imgproc.hpp>

namespace pilothouse::gui {

DepthRamp::DepthRamp() {
  cv::Mat levels(1, 256, CV_8UC1);
  for (int i = 0; i < 256; ++i)
    levels.at<unsigned char>(0, i) = static_cast<unsigned char>(255 - i);
  cv::Mat colours;
  cv::applyColorMap(levels, colours, cv::COLORMAP_VIRIDIS);
  table_.reserve(256);
  for (int i = 0; i < 256; ++i) {
    const auto& bgr = colours.at<cv::Vec3b>(0, i);
    table_.push_back(qRgb(bgr[2], bgr[1], bgr[0]));
  }
}

float DepthRamp::metres(QRgb colour, DepthSpan span) const {
  if (colour == nothing()) return 0.0F;
  const auto distance = [&](QRgb c) {
    return std::abs(qRed(c) - qRed(colour)) + std::abs(qGreen(c) - qGreen(colour)) +
           std::abs(qBlue(c) - qBlue(colour));
  };
  const auto best = std::min_element(table_.begin(), table_.end(),
                                     [&](QRgb a, QRgb b) { return distance(a) < distance(b); });
  const auto level = static_cast<float>(std::distance(table_.begin(), best));
  return span.near_m + (span.far_m - span.near_m) * level / 255.0F;
}

namespace {

constexpr float kBin = 0.05F;  // m
constexpr std::size_t kBins = 400;

// Distances that 1 % and 90 % of the measured pixels stay below, from a histogram of every seventh
// pixel: exact to a bin, and cheap. A far wall seen through a door must not take the colours away
// from the floor.
bool percentiles(const std::vector<float>& metres, float& low, float& high) {
  std::array<int, kBins> histogram{};
  int total = 0;
  for (std::size_t i = 0; i < metres.size(); i += 7) {
    if (!(metres[i] > 0.0F)) continue;
    ++histogram[std::min(kBins - 1, static_cast<std::size_t>(std::min(metres[i], 1e4F) / kBin))];
    ++total;
  }
  if (total < 16) return false;
  int below = 0;
  low = high = 0.0F;
  for (std::size_t i = 0; i < kBins; ++i) {
    if (below <= total / 100) low = static_cast<float>(i) * kBin;
    if (below <= total - total / 10) high = static_cast<float>(i + 1) * kBin;
    below += histogram[i];
  }
  return true;
}

float roundedUp(float metres) {
  for (const float step : {1.0F, 1.5F, 2.0F, 3.0F, 4.0F, 5.0F}) {
    if (metres <= step) return step;
  }
  return 6.0F;
}

}  // namespace

DepthSpan DepthSpanChooser::update(const std::vector<float>& metres) {
  float low = 0.0F;
  float high = 0.0F;
  if (!percentiles(metres, low, high)) return span_;
  const DepthSpan wanted{std::min(std::floor(low * 2.0F) * 0.5F, 2.0F), roundedUp(high)};
  const bool wider = wanted.far_m > span_.far_m || wanted.near_m < span_.near_m;
  const bool narrower = wanted.far_m < span_.far_m || wanted.near_m > span_.near_m;
  narrower_ = narrower ? narrower_ + 1 : 0;
  if (first_ || narrower_ >= 30) {
    span_ = wanted;
    narrower_ = 0;
  } else if (wider) {
    span_ = {std::min(span_.near_m, wanted.near_m), std::max(span_.far_m, wanted.far_m)};
  }
  if (span_.far_m - span_.near_m < 0.5F) span_.near_m = std::max(0.0F, span_.far_m - 0.5F);
  first_ = false;
  return span_;
}

}  // namespace pilothouse::gui
