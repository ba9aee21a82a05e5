#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "bench/drive_record.hpp"

namespace pilothouse::bench {

struct DriveFigure {
  std::string title;
  std::string expected, seen;
  bool pass = false;
  cv::Rect2d area;          ///< of the world that the map shows [m]
  double look_ahead = 2.0;  ///< the corridor is drawn so far [m]
};

/// One picture of a drive: depth in false colour and the map at its moment, and over the time the
/// speed with its limit, what limited it, and the free way.
cv::Mat drawDrive(const DriveRecord& record, const RobotDescription& robot,
                  const DriveFigure& figure);

}  // namespace pilothouse::bench
