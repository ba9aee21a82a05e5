#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <deque>

namespace pilothouse::gui {

/// Where the robot has been: a point every few centimetres, the oldest forgotten. A jump begins a
/// new line.
class Trail {
 public:
  static constexpr double kStep = 0.03;       ///< [m]
  static constexpr double kJump = 0.5;        ///< [m]
  static constexpr std::size_t kMost = 6000;  ///< points: about 180 m
  struct Point {
    Eigen::Vector2d place;
    bool begins = false;  ///< no line leads here
  };

  /// @return whether the trail grew.
  bool add(Eigen::Vector2d place) {
    if (!place.allFinite()) return false;
    const double moved = points_.empty() ? 1e9 : (place - points_.back().place).norm();
    if (moved < kStep) return false;
    points_.push_back({place, moved > kJump});
    if (points_.size() > kMost) points_.pop_front();
    return true;
  }
  void clear() { points_.clear(); }
  const std::deque<Point>& points() const { return points_; }

 private:
  std::deque<Point> points_;
};

}  // namespace pilothouse::gui
