#include "nodelets/simulator_settings.hpp"

#include "nodelets/sim_robot.hpp"
#include "sim/world_file.hpp"

namespace pilothouse {
namespace {

void readSensors(StrictParameters& reader, sim::SensorParameters& sensors) {
  std::string camera = "kinect";
  reader.read("camera", camera, sim::cameraProfileNames());
  if (const auto profile = sim::cameraProfile(camera)) sensors.camera = *profile;
  reader.read("blind_on_glass", sensors.camera.blind_on_glass);
  reader.read("blind_in_sunlight", sensors.camera.blind_in_sunlight);
  reader.read("depth_rate", sensors.depth_rate, 0.0, 100.0);
  reader.read("colour_rate", sensors.colour_rate, 0.0, 100.0);
}

/// Time must have one source.
void checkClock(StrictParameters& reader, const SimulatorSettings& settings) {
  if (settings.clock && !ros::Time::isSimTime()) {
    reader.addFault("clock is true, expected false unless /use_sim_time is true");
  }
  if (!settings.clock && ros::Time::isSimTime()) {
    reader.addFault("clock is false, expected true because /use_sim_time is true");
  }
  if (!settings.clock && settings.rate != 1.0) {
    reader.addFault("rate is not 1, expected 1 unless clock is true");
  }
}

}  // namespace

SimulatorSettings readSimulator(StrictParameters& reader, const RobotDescription& robot) {
  SimulatorSettings settings{simRobotOf(robot), robot.camera.frame};
  std::string path;
  int seed = 1;
  reader.require({"world"});
  reader.read("world", path);
  reader.read("seed", seed, 0);
  reader.read("rate", settings.rate, 0.0, 20.0);
  reader.read("clock", settings.clock);
  reader.accept("diagnostic_period");  // the updater's own
  readSensors(reader, settings.parameters.sensors);
  checkClock(reader, settings);
  if (!path.empty()) {
    auto loaded = sim::loadWorld(path);
    if (!loaded) {
      reader.addFault("world is " + path + ", which cannot be used: " + loaded.reason());
    } else {
      settings.world = std::move(loaded->world);
      settings.warnings = std::move(loaded->warnings);
    }
  }
  reader.finish();
  settings.parameters.seed = static_cast<std::uint64_t>(seed);
  return settings;
}

}  // namespace pilothouse
