#include "sim/sensors.hpp"

#include <cmath>

#include "sim/corrupt.hpp"

namespace pilothouse::sim {
namespace {

/// Whether a sensor of `rate` has its turn at the tick.
bool due(double rate, std::uint64_t tick, double dt) {
  const auto turns = [&](std::uint64_t ticks) {
    return std::floor(static_cast<double>(ticks) * dt * rate + 1e-9);
  };
  return tick > 0 && turns(tick) > turns(tick - 1);
}

/// An image that nobody else holds.
template <class Image>
std::shared_ptr<Image> unused(std::vector<std::shared_ptr<Image>>& pool) {
  for (const auto& image : pool) {
    if (image.use_count() == 1) return image;
  }
  pool.push_back(std::make_shared<Image>());
  return pool.back();
}

template <class T>
void spoil(T& value, Random& random) {
  corrupt(value, random);
}

}  // namespace

Sensors::Sensors(const World& world, const SimRobot& robot, const SensorParameters& parameters,
                 std::uint64_t seed)
    : parameters_(parameters),
      seed_(seed),
      T_base_camera_(robot.T_base_camera),
      wheel_radius_(robot.base.wheel_radius),
      camera_(world, parameters.camera),
      odometry_(robot.base, parameters.odometry, mixSeed(seed, 1)),
      imu_(parameters.imu, mixSeed(seed, 2)),
      depth_channel_(mixSeed(seed, 3), spoil<Depth>),
      colour_channel_(mixSeed(seed, 4), spoil<Colour>),
      odometry_channel_(mixSeed(seed, 5), spoil<OdometryReading>,
                        [](OdometryReading& reading) { reading.twist = {}; }),
      imu_channel_(mixSeed(seed, 6), spoil<ImuReading>,
                   [](ImuReading& reading) { reading.rate.setZero(); }) {
  for (std::size_t i = 0; i < robot.rangers.size(); ++i) {
    rangers_.emplace_back(robot.rangers[i], parameters.ranger, mixSeed(seed, 100 + 2 * i));
    range_channels_.emplace_back(mixSeed(seed, 101 + 2 * i), spoil<double>);
  }
}

void Sensors::step(const WorldScene& scene, const RobotBase& base, std::uint64_t tick, double dt,
                   Readings& readings, PartTimes& times) {
  const double now = static_cast<double>(tick) * dt;
  const WheelStates& wheels = base.drive().wheels();
  odometry_.step(wheels, dt);
  imu_.step(base.T_world_base(), dt);
  joints_.wheels = wheels;
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    joints_.turned[i] += wheels[i].speed * dt / wheel_radius_;
  }
  if (due(parameters_.imu_rate, tick, dt)) imu_channel_.offer(now, [&] { return imu_.reading(); });
  readings.joints.reset();
  if (due(parameters_.odometry_rate, tick, dt)) {
    odometry_channel_.offer(now, [&] { return odometry_.reading(); });
    readings.joints = Reading<JointReading>{now, joints_};
  }
  look(scene, base, tick, dt, times);
  readings.ranges.resize(rangers_.size());
  const bool range_due = due(parameters_.range_rate, tick, dt);
  for (std::size_t i = 0; i < rangers_.size(); ++i) {
    if (range_due) {
      range_channels_[i].offer(now, [&] {
        double range = 0.0;
        times.measure(PartTimes::kRangers,
                      [&] { range = rangers_[i].measure(scene, base.T_world_base()); });
        return range;
      });
    }
    readings.ranges[i] = range_channels_[i].take(now);
  }
  readings.depth = depth_channel_.take(now);
  readings.colour = colour_channel_.take(now);
  readings.odometry = odometry_channel_.take(now);
  readings.imu = imu_channel_.take(now);
}

void Sensors::look(const WorldScene& scene, const RobotBase& base, std::uint64_t tick, double dt,
                   PartTimes& times) {
  const double now = static_cast<double>(tick) * dt;
  const bool depth_due = due(parameters_.depth_rate, tick, dt);
  const bool colour_due = due(parameters_.colour_rate, tick, dt);
  if (depth_due) ++frames_;
  const bool colour_wanted = colour_due && colour_channel_.wantsValue(now);
  if (colour_wanted || (depth_due && depth_channel_.wantsValue(now))) {
    const auto wanted =
        colour_wanted ? WorldCamera::Wanted::kDepthAndColour : WorldCamera::Wanted::kDepth;
    times.measure(PartTimes::kRender,
                  [&] { camera_.render(scene, base.T_world_base() * T_base_camera_, wanted); });
  }
  if (depth_due) {
    depth_channel_.offer(now, [&] {
      Depth image;
      times.measure(PartTimes::kDepthNoise, [&] { image = measureDepth(); });
      return image;
    });
  }
  if (colour_due) {
    colour_channel_.offer(now, [&] {
      Colour image;
      times.measure(PartTimes::kColour, [&] { image = measureColour(); });
      return image;
    });
  }
}

Sensors::Depth Sensors::measureDepth() {
  const CameraModel& model = camera_.profile().model;
  const auto image = unused(depth_pool_);
  image->width = model.width;
  image->height = model.height;
  image->millimetres.resize(std::size_t{model.width} * model.height);
  camera_.depth(mixSeed(seed_, 7), frames_, image->millimetres.data());
  return image;
}

Sensors::Colour Sensors::measureColour() {
  const CameraModel& model = camera_.profile().model;
  const auto image = unused(colour_pool_);
  image->width = model.width;
  image->height = model.height;
  image->rgb.resize(std::size_t{3} * model.width * model.height);
  camera_.colour(image->rgb.data());
  return image;
}

bool Sensors::fail(const std::string& sensor, const Fault& fault) {
  bool found = false;
  forEachChannel(*this, [&](const std::string& name, auto& channel) {
    if (sensor != name && sensor != "all") return;
    channel.fail(fault);
    found = true;
  });
  return found;
}

std::vector<std::string> Sensors::names() const {
  std::vector<std::string> names;
  forEachChannel(*this, [&](const std::string& name, const auto&) { names.push_back(name); });
  return names;
}

std::vector<std::string> Sensors::failing(double now) const {
  std::vector<std::string> names;
  forEachChannel(*this, [&](const std::string& name, const auto& channel) {
    if (channel.failing(now)) names.push_back(name);
  });
  return names;
}

}  // namespace pilothouse::sim
