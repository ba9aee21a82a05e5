#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "core/motion/planar.hpp"

namespace pilothouse::sim {

/// What stands on a floor, as rectangles and discs: the ground truth that random worlds are planned
/// on.
class FloorPlan {
 public:
  /// A room from (0, 0) to size, with walls round it.
  explicit FloorPlan(const Eigen::Vector2d& size) : size_(size) {}

  const Eigen::Vector2d& size() const { return size_; }
  void addRectangle(const Pose2& middle, const Eigen::Vector2d& size);
  void addDisc(const Eigen::Vector2d& middle, double radius);
  /// Distance from a point to the nearest wall or thing [m]; negative within one.
  double clearance(const Eigen::Vector2d& point) const;
  /// Whether every point between the two has at least this clearance (asked for every 2 cm).
  bool isFree(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double clearance) const;
  /// The way from `start` that keeps the clearance and whose length comes nearest to `length` [m],
  /// pulled straight; none where there is no way of at least 1 m.
  std::optional<std::vector<Eigen::Vector2d>> routeFrom(const Eigen::Vector2d& start,
                                                        double clearance, double length) const;

 private:
  struct Rectangle {
    Pose2 middle;
    Eigen::Vector2d half;
  };
  struct Disc {
    Eigen::Vector2d middle;
    double radius;
  };
  std::vector<Eigen::Vector2d> pulled(const std::vector<Eigen::Vector2d>& way,
                                      double clearance) const;

  Eigen::Vector2d size_;
  std::vector<Rectangle> rectangles_;
  std::vector<Disc> discs_;
};

}  // namespace pilothouse::sim
