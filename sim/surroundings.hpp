#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "sim/footprint_contact.hpp"
#include "sim/sim_robot.hpp"
#include "sim/world_scene.hpp"

namespace pilothouse::sim {

/// The robot's body begins this far above its own ground plane: what is lower it drives over [m].
constexpr double kGroundClearance = 0.05;
constexpr std::size_t kNoModel = std::numeric_limits<std::size_t>::max();

/// How far it is to something, and to what.
struct FreeWay {
  double distance = std::numeric_limits<double>::infinity();  ///< [m]; negative: overlaps
  std::size_t model = kNoModel;                               ///< index into World::models
};

/// The solid things near a robot at the heights of its body, seen from above in its own plane.
/// Surfaces that face up and are no steeper than 30 degrees are ground: never in the way by
/// themselves. What surrounds the robot on all sides without touching it is not seen as contact.
class Surroundings {
 public:
  struct Near {
    std::size_t model;
    Slice slice;  ///< base frame at the time of collect()
  };

  /// @param reach how far from the footprint [m].
  void collect(const WorldScene& scene, const SimRobot& robot,
               const Eigen::Isometry3d& T_world_base, double reach);
  const std::vector<Near>& near() const { return near_; }

  /// From the footprint at `pose` of the collected frame to the nearest thing.
  FreeWay nearest(const Footprint& footprint, const Pose2& pose = {}) const;
  /// How far the footprint can go along the arc of `twist` until it touches something: the way of
  /// its fastest corner [m]. Things behind that it moves away from do not count.
  FreeWay along(const Footprint& footprint, const Twist2& twist, double farthest) const;

 private:
  std::vector<Near> near_;
};

}  // namespace pilothouse::sim
