#include "bench/drive_record.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

namespace pilothouse::bench {
namespace {

constexpr double kFlat = 0.03;  // what is no higher is ground, not drawn [m]

std::vector<Eigen::Vector2d> outlineOf(const sim::Part& part, const Eigen::Isometry3d& T_world) {
  std::vector<cv::Point2f> points;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const auto& vertex : part.mesh.vertices) {
    const Eigen::Vector3d place = T_world * vertex.cast<double>();
    points.emplace_back(static_cast<float>(place.x()), static_cast<float>(place.y()));
    low = std::min(low, place.z());
    high = std::max(high, place.z());
  }
  std::vector<Eigen::Vector2d> outline;
  if (points.size() < 3 || high < kFlat) return outline;
  std::vector<cv::Point2f> hull;
  cv::convexHull(points, hull);
  for (const auto& corner : hull) outline.emplace_back(corner.x, corner.y);
  return outline;
}

}  // namespace

double DriveRecord::slowest(double from, double to) const {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& s : samples) {
    if (s.time >= from && s.time <= to) least = std::min(least, s.measured);
  }
  return least;
}

double DriveRecord::fastest(double from, double to) const {
  double most = 0.0;
  for (const auto& s : samples) {
    if (s.time >= from && s.time <= to) most = std::max(most, s.measured);
  }
  return most;
}

void DriveRecorder::run(double seconds, const Condition& end, const Condition& worth) {
  const double until = loop_.simulation().time() + seconds;
  const DriveStep* step = nullptr;
  while (loop_.simulation().time() < until) {
    step = &loop_.step();
    const LimitedCommand& limited = step->limited;
    const DriveSample sample{step->time,
                             step->pose,
                             step->twist,
                             loop_.limiter().pathSpeed(step->wanted),
                             limited.limit.speed,
                             limited.limited,
                             loop_.limiter().pathSpeed(step->twist),
                             limited.limit.obstacle_distance,
                             limited.limit.potential_distance,
                             limited.limit.cause};
    record_.samples.push_back(sample);
    if (!record_.has_moment && worth(sample, *step)) keepMoment(*step);
    record_.reached = step->executor.state == ExecutorState::kReached;
    if (end(sample, *step)) break;
  }
  if (!record_.has_moment && step != nullptr) keepMoment(*step);
  record_.contacts = loop_.simulation().base().contacts().size();
}

void DriveRecorder::keepMoment(const DriveStep& step) {
  if (loop_.floor() == nullptr || !loop_.depth()) return;
  DriveMoment& moment = record_.moment;
  record_.has_moment = true;
  moment.time = step.time;
  moment.pose = step.pose;
  const sim::DepthImage& depth = *loop_.depth();
  moment.depth = cv::Mat(static_cast<int>(depth.height), static_cast<int>(depth.width), CV_16UC1);
  std::copy(depth.millimetres.begin(), depth.millimetres.end(),
            moment.depth.begin<std::uint16_t>());
  moment.geometry = loop_.floor()->geometry;
  moment.classes = loop_.floor()->classes;
  moment.surroundings = loop_.surroundings();
  moment.way = step.limited.command.linear() > 0.02 || std::abs(step.limited.command.w) > 0.02
                   ? step.limited.command
                   : step.wanted;
  const auto& models = loop_.simulation().world().models;
  for (std::size_t i = 0; i < models.size(); ++i) {
    for (const auto& part : models[i].parts) {
      auto outline = outlineOf(part, loop_.simulation().scene().pose(i));
      if (!outline.empty()) moment.outlines.push_back(std::move(outline));
    }
  }
}

}  // namespace pilothouse::bench
