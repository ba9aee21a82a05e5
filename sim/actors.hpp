#pragma once

#include <vector>

#include "core/motion/footprint.hpp"
#include "sim/footprint_contact.hpp"
#include "sim/world_scene.hpp"

namespace pilothouse::sim {

/// Everybody in a world who follows a path. Each has a clock of their own, which stands while the
/// robot is in the way of somebody courteous, who after a while, or at once where the robot comes
/// towards them, turns round, walks back to where the path begins and lets the robot go first.
class Actors {
 public:
  struct Robot {
    const Footprint& footprint;
    Pose2 pose;    ///< world
    Twist2 twist;  ///< base frame
  };

  explicit Actors(const World& world);

  /// Moves them on by `dt` [s]; the scene sees it after its commit().
  /// @param robot how it stands and moves: people do not step right before it either.
  void step(WorldScene& scene, const Robot& robot, double dt);
  /// From now on the model stands where it was put. No effect on one that is no actor.
  void release(std::size_t model);

 private:
  struct Actor {
    std::size_t number;  ///< index into World::models
    const Model* model;
    double radius;  ///< of the circle round its solid parts [m]
    double clock = 0.0;
    double sense = 1.0;   ///< -1: walks back
    double waited = 0.0;  ///< for the robot [s]
    double rest = 0.0;    ///< stands at the begin of the path for so long yet [s]
    bool walks = true;
  };
  static void walk(Actor& actor, double dt);
  static bool robotAhead(const Actor& actor, const Robot& robot, double dt);
  static bool robotComes(const Actor& actor, const Robot& robot);
  static Slice bodyOf(const Actor& actor, const Pose2& pose, const Eigen::Vector2d& along);
  static bool reaches(const Robot& robot, const Slice& place);

  std::vector<Actor> actors_;
};

}  // namespace pilothouse::sim
