#pragma once

#include <string>
#include <vector>

#include "sim/ground_support.hpp"
#include "sim/random.hpp"
#include "sim/sim_robot.hpp"
#include "sim/surroundings.hpp"
#include "sim/wheel_drive.hpp"
#include "sim/world_scene.hpp"

namespace pilothouse::sim {

/// How the base's motion differs from what its wheels say.
struct BaseNoise {
  double slip = 0.01;       ///< spread of the share by which speeds are off, 0..0.3
  double sideways = 0.003;  ///< spread of the drift sideways, as a share of the way, 0..0.1
  double turning = 0.005;   ///< spread of the turn that nobody asked for [rad/m], 0..0.5
  double time = 0.5;        ///< for how long an error lasts [s], 0.01..60
};

/// The begin of a contact.
struct Contact {
  std::size_t model = kNoModel;  ///< kNoModel: a wheel went over an edge
  double time = 0.0;             ///< [s]
  /// How fast the robot itself closed in [m/s]; 0: it stood or moved along or away, and was run
  /// into.
  double robot_speed = 0.0;
};

/// The simulated base on the ground of a world: wheels, slip, true pose, and what it touches. It
/// does not go through what it touches, and stays where it is after a drop until placed anew.
class RobotBase {
 public:
  RobotBase(const SimRobot& robot, const BaseNoise& noise, std::uint64_t seed);

  void place(const WorldScene& scene, const Pose2& pose, double from_z = 0.3);
  void command(const Twist2& twist, double now) { drive_.command(twist, now); }
  void forgetCommand() { drive_.forgetCommand(); }
  /// @param scene committed. Advances by `dt` to `now` [s].
  void step(const WorldScene& scene, double now, double dt);

  const Pose2& pose() const { return pose_; }     ///< true, world
  const Twist2& twist() const { return twist_; }  ///< true, base frame
  const Eigen::Isometry3d& T_world_base() const { return stance_.T_world_base; }
  const WheelDrive& drive() const { return drive_; }
  const SimRobot& robot() const { return robot_; }

  const std::vector<std::size_t>& touching() const { return touching_; }  ///< models, rising
  bool dropped() const { return stance_.drop; }
  const std::vector<Contact>& contacts() const { return contacts_; }  ///< all since the start

 private:
  Twist2 slipped(const Twist2& rolled, double dt);
  /// The share of the step that can be driven without going into anything.
  double freeShare(const Twist2& twist, double dt) const;
  /// @param share of the step to `wish` that is driven.
  void noteTouched(const Twist2& wish, double share, double now, double dt);

  SimRobot robot_;
  BaseNoise noise_;
  Random random_;
  WheelDrive drive_;
  GroundSupport ground_;
  Surroundings surroundings_;
  Pose2 pose_;
  Twist2 twist_;
  Stance stance_;
  double slips_[4] = {0.0, 0.0, 0.0, 0.0};  ///< standard normal, correlated in time
  std::vector<std::size_t> touching_, touched_before_;
  std::vector<Contact> contacts_;
};

}  // namespace pilothouse::sim
