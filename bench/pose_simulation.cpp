#include "bench/pose_simulation.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include "core/cloud/depth_view.hpp"
#include "core/floor/floor_segmenter.hpp"
#include "core/floor/level_scan.hpp"
#include "core/floor/virtual_scan.hpp"
#include "core/motion/motion_executor.hpp"
#include "core/pose/pose_algebra.hpp"
#include "doors/package_files.hpp"
#include "nodelets/sim_robot.hpp"
#include "sim/random_world.hpp"
#include "sim/simulation.hpp"
#include "sim/world_file.hpp"

namespace pilothouse::bench {
namespace {

constexpr double kMaxSeconds = 90.0, kTourSeconds = 180.0;                    // simulated
constexpr double kLaserHeight = 0.3, kLaserReach = 12.0, kLaserNoise = 0.01;  // [m]
constexpr int kBeams = 360;
constexpr double kTurn = 6.283185307179586;

sim::SimulationParameters slippery(std::uint64_t seed, SimulatedScanner scanner) {
  sim::SimulationParameters parameters;
  parameters.seed = seed;
  parameters.base.slip = 0.05;
  parameters.base.sideways = 0.01;
  parameters.base.turning = 0.03;
  parameters.sensors.camera = *sim::cameraProfile("kinect_qvga");
  parameters.sensors.colour_rate = parameters.sensors.range_rate = 0.0;
  parameters.sensors.depth_rate = scanner == SimulatedScanner::kLaser ? 0.0 : 15.0;
  return parameters;
}

sim::RandomWorldParameters worldOf() {
  sim::RandomWorldParameters parameters;
  parameters.blocked_share = parameters.ramp_share = parameters.sill_share = 0.0;
  parameters.route_length = 12.0;
  return parameters;
}

const char* nameOf(SimulatedScanner scanner) {
  switch (scanner) {
    case SimulatedScanner::kLaser:
      return "laser";
    case SimulatedScanner::kLevel:
      return "level_scan";
    case SimulatedScanner::kVirtual:
      return "virtual_scan";
  }
  return "?";
}

class Drive {
 public:
  Drive(const RobotDescription& robot, sim::World world,
        const sim::SimulationParameters& parameters, SimulatedScanner scanner)
      : scanner_(scanner),
        random_(sim::mixSeed(parameters.seed, 7)),
        simulation_(std::move(world), simRobotOf(robot), parameters),
        segmenter_(robot.floor),
        T_base_optical_((bodyPose(robot.camera) * opticalRotation()).cast<float>()),
        executor_(ExecutorParameters{}, robot.drive) {
    recording_.odometry = "wheels";
    recording_.gyro = "gyroscope";
    recording_.reference_name = "simulator";
    recording_.scan_names = {nameOf(scanner)};
  }

  /// @param loop the route is driven round and round until the time is over.
  PoseRecording run(const std::string& route, bool loop, double seconds) {
    const auto& routes = simulation_.world().routes;
    executor_.drive(routes.at(route), std::nullopt, loop, simulation_.base().pose());
    for (int tick = 1; simulation_.time() < seconds; ++tick) {
      take(simulation_.step());
      if (tick % 10 == 0) look();
      if (tick % 2 != 0) continue;
      ExecutorInput input;
      input.now = simulation_.time();
      input.pose = simulation_.base().pose();
      const ExecutorOutput output = executor_.step(input);
      simulation_.command(output.wanted);
      if (output.state == ExecutorState::kReached) break;
    }
    return std::move(recording_);
  }

 private:
  void take(const sim::Readings& readings) {
    if (readings.imu) {
      recording_.events.push_back(GyroEvent{readings.imu->stamp, readings.imu->value.rate.z()});
    }
    if (readings.odometry) {
      recording_.events.push_back(
          OdometryEvent{readings.odometry->stamp, readings.odometry->value.pose});
    }
    if (readings.depth) judge(*readings.depth->value, readings.depth->stamp);
  }

  /// The truth, and the laser.
  void look() {
    const double now = simulation_.time();
    const Pose2 pose = simulation_.base().pose();
    recording_.reference.emplace_back(now, pose);
    if (scanner_ != SimulatedScanner::kLaser) return;
    ScanBeams beams{now, -0.5 * kTurn, kTurn / kBeams, 0.0, 0.05, kLaserReach, {}};
    for (int i = 0; i < kBeams; ++i) {
      const double bearing = pose.heading + beams.angle_min + i * beams.angle_increment;
      const auto hit = simulation_.scene().cast({pose.x, pose.y, kLaserHeight},
                                                {std::cos(bearing), std::sin(bearing), 0.0},
                                                kLaserReach, sim::kRangerRay);
      beams.ranges.push_back(
          hit ? hit->distance + static_cast<float>(kLaserNoise * random_.normal()) : INFINITY);
    }
    recording_.events.push_back(ScanEvent{0, std::move(beams), {}});
  }

  void judge(const sim::DepthImage& image, double stamp) {
    const auto& camera = simulation_.sensors().camera().model;
    DepthBytes bytes{};
    bytes.width = image.width;
    bytes.height = image.height;
    bytes.step = image.width * 2;
    bytes.encoding = "16UC1";
    bytes.data = reinterpret_cast<const std::uint8_t*>(image.millimetres.data());
    bytes.size = image.millimetres.size() * 2;
    bytes.info_width = camera.width;
    bytes.info_height = camera.height;
    bytes.intrinsics = camera.intrinsics;
    const auto view = DepthView::open(bytes);
    if (!view) return;
    const bool cells = scanner_ == SimulatedScanner::kVirtual;
    const auto& ranges = cells ? scan_.scan(segmenter_.segment(*view, T_base_optical_))
                               : level_.scan(*view, T_base_optical_);
    const ScanGeometry& geometry = cells ? scan_.geometry() : level_.geometry();
    recording_.events.push_back(ScanEvent{
        0,
        {stamp, static_cast<double>(geometry.angle_min), static_cast<double>(geometry.increment),
         0.0, 0.0, static_cast<double>(geometry.range_max), ranges},
        {}});
  }

  SimulatedScanner scanner_;
  sim::Random random_;
  sim::Simulation simulation_;
  FloorSegmenter segmenter_;
  VirtualScan scan_;
  LevelScan level_;
  Eigen::Isometry3f T_base_optical_;
  MotionExecutor executor_;
  PoseRecording recording_;
};

}  // namespace

PoseRecording simulatePose(const RobotDescription& robot, std::uint64_t seed,
                           SimulatedScanner scanner) {
  return Drive(robot, sim::randomWorld(seed, worldOf()).world, slippery(seed, scanner), scanner)
      .run("route", false, kMaxSeconds);
}

PoseRecording simulateTour(const RobotDescription& robot, std::uint64_t seed,
                           SimulatedScanner scanner) {
  auto loaded = sim::loadWorld(packageFile("maps/furnished_room.sdf"));
  if (!loaded) throw std::runtime_error(loaded.reason());
  sim::SimulationParameters parameters = slippery(seed, scanner);
  parameters.base = {};
  return Drive(robot, std::move(loaded->world), parameters, scanner)
      .run("tour", true, kTourSeconds);
}

PoseRecording slipping(PoseRecording recording, double share) {
  auto& events = recording.events;
  events.erase(std::remove_if(events.begin(), events.end(),
                              [](const auto& e) { return std::holds_alternative<GyroEvent>(e); }),
               events.end());
  recording.gyro.clear();
  std::optional<Pose2> before;
  Pose2 counted;
  for (auto& event : events) {
    auto* odometry = std::get_if<OdometryEvent>(&event);
    if (odometry == nullptr) continue;
    if (!before) before = counted = odometry->T_odom_base;
    const Pose2 step = relative(*before, odometry->T_odom_base);
    const double scale = 1.0 + share;
    before = odometry->T_odom_base;
    counted = composed(counted, {scale * step.x, scale * step.y, scale * step.heading});
    odometry->T_odom_base = counted;
  }
  return recording;
}

}  // namespace pilothouse::bench
