#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/actors.hpp"
#include "sim/part_times.hpp"
#include "sim/robot_base.hpp"
#include "sim/sensors.hpp"
#include "sim/world.hpp"

namespace pilothouse::sim {

struct SimulationParameters {
  std::uint64_t seed = 1;
  SensorParameters sensors;
  BaseNoise base;
};

/// A robot in a world, in this process: give it commands, step it, read its sensors. No threads, no
/// clock of its own; the same world, robot, parameters and calls give the same readings bit by bit.
class Simulation {
 public:
  static constexpr double kTick = 0.01;  ///< [s]

  /// The robot stands at the world's start.
  /// @throws std::runtime_error where Embree cannot be used.
  Simulation(World world, const SimRobot& robot, const SimulationParameters& parameters = {});
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// What the base gets as cmd_vel, now. It halts when it gets nothing for its command_timeout.
  void command(const Twist2& twist) { base_.command(twist, time()); }
  /// As if the last command were too old.
  void forgetCommand() { base_.forgetCommand(); }
  /// Advances by a tick. @return what the sensors deliver at its end, valid until the next step.
  const Readings& step();

  double time() const { return static_cast<double>(ticks_) * kTick; }  ///< since the start [s]
  const World& world() const { return world_; }
  const WorldScene& scene() const { return scene_; }
  const RobotBase& base() const { return base_; }  ///< with the truth about pose and contacts
  const Sensors& sensors() const { return sensors_; }
  const PartTimes& times() const { return times_; }

  /// Makes a sensor fail for `seconds` (0: until changed).
  /// @return the reason why not; nothing: done.
  std::optional<std::string> fail(const std::string& sensor, FaultKind kind, double amount,
                                  double seconds);
  /// Puts a model, or the robot by the name "robot", somewhere else. An actor stands there from
  /// then on. @return the reason why not; nothing: done.
  std::optional<std::string> place(const std::string& model, const Pose2& pose);

  /// Truth for judging: from the footprint to the nearest solid thing within `reach` [m].
  FreeWay freeDistance(double reach = 3.0);
  /// And along the arc of `twist`: Surroundings::along().
  FreeWay freeAlong(const Twist2& twist, double farthest = 3.0);
  /// Name of what a contact or a free way is about; "drop" for kNoModel.
  const std::string& nameOf(std::size_t model) const;

 private:
  World world_;
  WorldScene scene_;
  Actors actors_;
  RobotBase base_;
  Sensors sensors_;
  Surroundings around_;
  Readings readings_;
  PartTimes times_;
  std::uint64_t ticks_ = 0;
};

}  // namespace pilothouse::sim
