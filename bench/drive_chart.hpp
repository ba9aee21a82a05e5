#pragma once

#include <opencv2/core.hpp>

#include "bench/drive_record.hpp"
#include "bench/figure_canvas.hpp"

namespace pilothouse::bench {

/// Speeds, what limited them, and the free way over the time, within `box`.
void drawDriveChart(FigureCanvas& canvas, const cv::Rect2d& box, const DriveRecord& record);

}  // namespace pilothouse::bench
