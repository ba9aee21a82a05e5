#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "core/cloud/cloud_view.hpp"
#include "core/cloud/depth_view.hpp"
#include "core/floor/floor_cells.hpp"

namespace pilothouse::bench {

/// Depth [mm] of an organised cloud or a depth picture, as drawDepth() takes it.
cv::Mat depthOf(const CloudView& cloud);
cv::Mat depthOf(const DepthView& depth);

/// The picture (8-bit, 3 channels) tinted by the class of each of its points; unknown stays as is.
cv::Mat tint(const cv::Mat& picture, const std::vector<CellClass>& classes);

}  // namespace pilothouse::bench
