#pragma once

#include <functional>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "bench/drive_loop.hpp"

namespace pilothouse::bench {

/// One control step as the speed graph has it; speeds are path speeds [m/s].
struct DriveSample {
  double time = 0.0;
  Pose2 pose;  ///< true, world
  Twist2 twist;
  double wanted = 0.0, limit = 0.0, limited = 0.0, measured = 0.0;
  double obstacle_distance = 0.0, potential_distance = 0.0;
  LimitCause cause = LimitCause::kFree;
};

/// Everything at one instant, for the depth picture and the map.
struct DriveMoment {
  double time = 0.0;
  Pose2 pose;
  cv::Mat depth;  ///< 16-bit [mm]
  GridGeometry geometry;
  std::vector<CellClass> classes;
  Surroundings surroundings;
  Twist2 way;  ///< that the corridor is drawn for
  /// Outlines of everything that stands in the world but floors [m].
  std::vector<std::vector<Eigen::Vector2d>> outlines;
};

struct DriveRecord {
  std::vector<DriveSample> samples;
  DriveMoment moment;
  bool has_moment = false;
  std::vector<Eigen::Vector2d> route;
  std::size_t contacts = 0;
  bool reached = false;

  double slowest(double from, double to) const;  ///< measured, within these times
  double fastest(double from, double to) const;
};

/// Steps the loop until `end` says so or `seconds` are over, and keeps the moment at which `worth`
/// holds first (else the last one).
class DriveRecorder {
 public:
  using Condition = std::function<bool(const DriveSample&, const DriveStep&)>;
  explicit DriveRecorder(DriveLoop& loop) : loop_(loop) {}
  void run(double seconds, const Condition& end, const Condition& worth);
  DriveRecord& record() { return record_; }

 private:
  void keepMoment(const DriveStep& step);
  DriveLoop& loop_;
  DriveRecord record_;
};

}  // namespace pilothouse::bench
