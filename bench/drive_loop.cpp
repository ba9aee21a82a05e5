#include "bench/drive_loop.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

#include "core/cloud/depth_view.hpp"
#include "nodelets/sim_robot.hpp"

namespace pilothouse::bench {
namespace {

constexpr int kTicks = 2;            // of the simulation in a control step
constexpr double kHeldBelow = 0.01;  // [m/s]

sim::SimulationParameters sensorsOf(DriveLoopParameters parameters) {
  parameters.simulation.sensors.colour_rate = 0.0;
  parameters.simulation.sensors.imu_rate = 0.0;
  if (!parameters.limited) parameters.simulation.sensors.depth_rate = 0.0;
  return parameters.simulation;
}

}  // namespace

DriveLoop::DriveLoop(sim::World world, const RobotDescription& robot,
                     const DriveLoopParameters& parameters)
    : parameters_(parameters),
      robot_(robot),
      simulation_(std::move(world), simRobotOf(robot), sensorsOf(parameters)),
      segmenter_(robot.floor),
      T_base_optical_((bodyPose(robot.camera) * opticalRotation()).cast<float>()),
      merger_(robot.avoidance, robot.outline(), rangersOf(robot)),
      limiter_(robot.avoidance, robot.drive, robot.outline()),
      executor_(parameters.executor, robot.drive),
      range_stamps_(robot.rangers.size(), -1.0) {}

DriveLoop::~DriveLoop() = default;

void DriveLoop::drive(const std::vector<Eigen::Vector2d>& points, std::optional<double> heading,
                      bool loop) {
  direct_.reset();
  executor_.drive(points, heading, loop, simulation_.base().pose());
}

void DriveLoop::want(const Twist2& twist) {
  direct_ = twist;
}

void DriveLoop::judge(const sim::DepthImage& image, double stamp) {
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
  if (!view) return;  // a corrupted picture: the robot goes without it
  floor_ = &segmenter_.segment(*view, T_base_optical_);
  const FloorFrame frame{stamp, floor_->geometry, floor_->classes.data(), floor_->heights.data()};
  if (merger_.floor(frame)) floor_stamp_ = stamp;
  step_.new_floor = true;
}

void DriveLoop::take(const sim::Readings& readings) {
  if (readings.odometry) {
    const auto& odometry = *readings.odometry;
    if (merger_.odometry(odometry.stamp, odometry.value.pose, odometry.value.twist)) {
      odometry_stamp_ = odometry.stamp;
      measured_ = odometry.value.twist;
    }
  }
  if (readings.depth) {
    waiting_.push_back(
        {readings.time + parameters_.camera_delay, readings.depth->stamp, readings.depth->value});
  }
  while (!waiting_.empty() && waiting_.front().due <= readings.time) {
    newest_depth_ = waiting_.front().image;
    judge(*newest_depth_, waiting_.front().stamp);
    waiting_.erase(waiting_.begin());
  }
  for (std::size_t i = 0; i < readings.ranges.size(); ++i) {
    const auto& range = readings.ranges[i];
    if (!range) continue;
    const RangerOnRobot& ranger = robot_.rangers[i];
    const RangeReading reading{range->value, ranger.field_of_view_deg * 3.14159265358979 / 180.0,
                               ranger.min_range, ranger.max_range};
    if (merger_.range(i, range->stamp, reading)) range_stamps_[i] = range->stamp;
  }
}

void DriveLoop::control() {
  const double now = simulation_.time();
  ExecutorInput executor;
  executor.now = now;
  executor.pose = simulation_.base().pose();
  const LimitedCommand& last = step_.limited;
  const bool held =
      parameters_.limited && last.wanted > kHeldBelow && last.limit.speed < kHeldBelow;
  if (held) {
    executor.hold = last.limit.remembered ? Hold::kRemembered : Hold::kSeen;
    executor.reason = "held";
    if (last.limit.position.allFinite()) executor.held_by = last.limit.position;
  }
  step_.executor = executor_.step(executor);
  step_.wanted = direct_ ? *direct_ : step_.executor.wanted;
  if (!parameters_.limited) {
    simulation_.command(step_.wanted);
    return;
  }
  surroundings_ = merger_.merge(now);
  LimiterInput input;
  input.dt = kTicks * sim::Simulation::kTick;
  input.wanted = step_.wanted;
  input.measured = measured_;
  double oldest = floor_stamp_;
  for (const double stamp : range_stamps_) oldest = std::min(oldest, stamp);
  input.perception_age = oldest < 0.0 ? HUGE_VAL : now - oldest;
  const auto pose = merger_.pose(now);
  input.odometry_age = pose ? now - odometry_stamp_ : HUGE_VAL;
  const SpeedLimiter::Looked looked = [&](const Eigen::Vector2d& place) {
    return pose && merger_.memory().looked(*pose * place, now);
  };
  step_.limited = limiter_.step(input, surroundings_, looked);
  simulation_.command(step_.limited.command);
}

const DriveStep& DriveLoop::step() {
  step_.new_floor = false;
  for (int i = 0; i < kTicks; ++i) take(simulation_.step());
  control();
  step_.time = simulation_.time();
  step_.pose = simulation_.base().pose();
  step_.twist = simulation_.base().twist();
  return step_;
}

}  // namespace pilothouse::bench
