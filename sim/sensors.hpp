#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/part_times.hpp"
#include "sim/ranger.hpp"
#include "sim/readings.hpp"
#include "sim/world_camera.hpp"

namespace pilothouse::sim {

/// Rates and errors of a robot's sensors.
struct SensorParameters {
  CameraProfile camera = *cameraProfile("kinect");
  double depth_rate = 30.0;     ///< [Hz], 0..100; 0: never
  double colour_rate = 15.0;    ///< [Hz], 0..100
  double odometry_rate = 50.0;  ///< of the joints too [Hz], 0..100
  double imu_rate = 100.0;      ///< [Hz], 0..100
  double range_rate = 20.0;     ///< [Hz], 0..100
  OdometryNoise odometry;
  ImuNoise imu;
  RangerNoise ranger;
};

/// All sensors of one simulated robot: each when its turn comes, and through its faults.
class Sensors {
 public:
  /// @param world must outlive this.
  Sensors(const World& world, const SimRobot& robot, const SensorParameters& parameters,
          std::uint64_t seed);

  /// @param tick counts from 1; its instant is tick * dt.
  /// @param readings receives what arrives at this tick.
  void step(const WorldScene& scene, const RobotBase& base, std::uint64_t tick, double dt,
            Readings& readings, PartTimes& times);
  /// The robot was put somewhere else.
  void restart() { imu_.restart(); }

  /// Makes a sensor (or all) fail. @return whether there is one of that name.
  bool fail(const std::string& sensor, const Fault& fault);
  /// camera, colour, odometry, imu, and the rangers'.
  std::vector<std::string> names() const;
  /// Names of the sensors that were made to fail and still do.
  std::vector<std::string> failing(double now) const;
  const CameraProfile& camera() const { return camera_.profile(); }

 private:
  using Depth = std::shared_ptr<const DepthImage>;
  using Colour = std::shared_ptr<const ColourImage>;

  /// Calls visit(name, channel) for each of `self`, which may be const.
  template <class Self, class Visit>
  static void forEachChannel(Self& self, Visit visit) {
    visit(std::string("camera"), self.depth_channel_);
    visit(std::string("colour"), self.colour_channel_);
    visit(std::string("odometry"), self.odometry_channel_);
    visit(std::string("imu"), self.imu_channel_);
    for (std::size_t i = 0; i < self.rangers_.size(); ++i) {
      visit(self.rangers_[i].ranger().name, self.range_channels_[i]);
    }
  }
  void look(const WorldScene& scene, const RobotBase& base, std::uint64_t tick, double dt,
            PartTimes& times);
  Depth measureDepth();
  Colour measureColour();

  SensorParameters parameters_;
  std::uint64_t seed_;
  Eigen::Isometry3d T_base_camera_;
  double wheel_radius_;
  WorldCamera camera_;
  Odometry odometry_;
  Imu imu_;
  std::vector<Ranger> rangers_;
  JointReading joints_;
  std::uint64_t frames_ = 0;  ///< of depth that were due
  std::vector<std::shared_ptr<DepthImage>> depth_pool_;
  std::vector<std::shared_ptr<ColourImage>> colour_pool_;
  SensorChannel<Depth> depth_channel_;
  SensorChannel<Colour> colour_channel_;
  SensorChannel<OdometryReading> odometry_channel_;
  SensorChannel<ImuReading> imu_channel_;
  std::vector<SensorChannel<double>> range_channels_;
};

}  // namespace pilothouse::sim
