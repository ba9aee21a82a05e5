#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/floor/floor_segmenter.hpp"
#include "core/motion/motion_executor.hpp"
#include "core/motion/object_merger.hpp"
#include "core/motion/speed_limiter.hpp"
#include "doors/robot_description.hpp"
#include "sim/simulation.hpp"

namespace pilothouse::bench {

struct DriveLoopParameters {
  sim::SimulationParameters simulation;
  ExecutorParameters executor;
  bool limited = true;  ///< false: what is wanted goes to the base, and no camera runs
  /// From a depth picture's stamp until it is judged [s]: the camera's and the drivers' share.
  double camera_delay = 0.04;
};

/// What happened in one control step.
struct DriveStep {
  double time = 0.0;  ///< simulated [s]
  Pose2 pose;         ///< true, world
  Twist2 twist;       ///< true, base frame
  Twist2 wanted;
  LimitedCommand limited;
  ExecutorOutput executor;
  bool new_floor = false;  ///< a depth picture was judged in this step
};

/// The whole chain in one process and without ROS: simulated robot, floor, memory, limiter,
/// executor, 50 times a simulated second. The executor knows the true pose (finding it is another
/// part's work); all that keeps the robot off things works from noisy odometry.
class DriveLoop {
 public:
  DriveLoop(sim::World world, const RobotDescription& robot, const DriveLoopParameters& parameters);
  ~DriveLoop();

  /// Drives the route of points in the world.
  void drive(const std::vector<Eigen::Vector2d>& points, std::optional<double> heading, bool loop);
  /// Wants this twist from now on, instead of a route's.
  void want(const Twist2& twist);
  /// Simulates 20 ms.
  const DriveStep& step();

  sim::Simulation& simulation() { return simulation_; }
  const FloorCells* floor() const { return floor_; }  ///< newest; null before the first
  const Surroundings& surroundings() const { return surroundings_; }
  /// Newest depth picture; null before the first.
  const std::shared_ptr<const sim::DepthImage>& depth() const { return newest_depth_; }
  const SpeedLimiter& limiter() const { return limiter_; }

 private:
  void take(const sim::Readings& readings);
  void judge(const sim::DepthImage& image, double stamp);
  void control();

  DriveLoopParameters parameters_;
  RobotDescription robot_;
  sim::Simulation simulation_;
  FloorSegmenter segmenter_;
  const FloorCells* floor_ = nullptr;
  Eigen::Isometry3f T_base_optical_;
  ObjectMerger merger_;
  SpeedLimiter limiter_;
  MotionExecutor executor_;
  std::optional<Twist2> direct_;
  Surroundings surroundings_;
  struct Waiting {
    double due, stamp;
    std::shared_ptr<const sim::DepthImage> image;
  };
  std::vector<Waiting> waiting_;
  std::shared_ptr<const sim::DepthImage> newest_depth_;
  std::vector<double> range_stamps_;
  double floor_stamp_ = -1.0, odometry_stamp_ = -1.0;
  Twist2 measured_;
  DriveStep step_;
};

}  // namespace pilothouse::bench
