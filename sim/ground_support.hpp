#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "core/motion/planar.hpp"
#include "sim/sim_robot.hpp"
#include "sim/wheel_drive.hpp"
#include "sim/world_scene.hpp"

namespace pilothouse::sim {

/// A wheel or castor that lies this much lower than the robot's own plane has gone over an edge
/// [m].
constexpr double kDropHeight = 0.05;

/// How a robot stands on the ground of a world.
struct Stance {
  Eigen::Isometry3d T_world_base = Eigen::Isometry3d::Identity();
  bool drop = false;  ///< a wheel hangs over an edge, or there is no ground under it
};

/// Where a robot's wheels meet the ground. A differential base rests on a castor in front and one
/// behind as well.
class GroundSupport {
 public:
  explicit GroundSupport(const SimRobot& robot);

  /// Puts the robot down at `pose` of the world, on ground up to `from_z` [m].
  Stance putDown(const WorldScene& scene, const Pose2& pose, double from_z) const;
  /// Moves it to `pose`, near where it stood: its plane is that through the wheels, each of which
  /// rolls over edges by its radius, and climbs steps no higher than kDropHeight.
  Stance moveOn(const WorldScene& scene, const Pose2& pose, const Stance& before,
                const WheelStates& wheels) const;

 private:
  struct Foot {
    Eigen::Vector2d at;  ///< base frame [m]
    int wheel;           ///< index into the kinematics' wheels; -1: castor
  };
  Eigen::Isometry3d planeThrough(const Pose2& pose, const std::vector<double>& heights) const;

  double radius_;
  std::vector<Foot> feet_;
  mutable std::vector<double> heights_;  ///< scratch
};

}  // namespace pilothouse::sim
