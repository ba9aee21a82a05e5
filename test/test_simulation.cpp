// The robot in its world as a whole, in this process.
#include "sim/simulation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <functional>

#include "sim/random_world.hpp"
#include "sim/world_file.hpp"
#include "test/sim_worlds.hpp"

namespace pilothouse::sim {
namespace {

World room() {
  World world = flatWorld();
  world.start = {0.5, -0.2, 0.3};
  add(world, "wall", boxMesh({0.1F, 8.0F, 2.5F}), at(4.0, 0.0));
  add(world, "box", boxMesh({0.3F, 0.4F, 0.4F}), at(2.2, 0.3));
  add(world, "walker", boxMesh({0.3F, 0.3F, 1.7F}), at(3.0, 2.0));
  world.models.back().path = ActorPath{{{0.0, {3.0, 2.0, 0.0}}, {4.0, {3.0, -2.0, 0.0}}}, true};
  return world;
}

SimulationParameters small(std::uint64_t seed) {
  SimulationParameters parameters;
  parameters.seed = seed;
  parameters.sensors.camera = *cameraProfile("tof");
  return parameters;
}

/// FNV-1a over everything that the sensors deliver.
class Hash {
 public:
  void add(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const std::uint8_t*>(data);
    for (std::size_t i = 0; i < size; ++i) value_ = (value_ ^ bytes[i]) * 1099511628211ULL;
  }
  void add(double value) {
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    add(&bits, sizeof bits);
  }
  void add(const Readings& r) {
    if (r.depth) {
      add(r.depth->stamp);
      const auto& pixels = r.depth->value->millimetres;
      add(pixels.data(), 2 * pixels.size());
    }
    if (r.colour) add(r.colour->value->rgb.data(), r.colour->value->rgb.size());
    if (r.odometry) {
      const auto& [pose, twist] = r.odometry->value;
      for (const double v : {pose.x, pose.y, pose.heading, twist.vx, twist.vy, twist.w}) add(v);
    }
    if (r.imu) {
      for (int i = 0; i < 3; ++i) add(r.imu->value.rate[i]);
      for (int i = 0; i < 3; ++i) add(r.imu->value.acceleration[i]);
    }
    if (r.joints) {
      for (const auto& wheel : r.joints->value.wheels) add(wheel.angle), add(wheel.speed);
    }
    for (const auto& range : r.ranges) {
      if (range) add(range->value);
    }
    for (const auto& contact : r.contacts) add(contact.robot_speed);
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 1469598103934665603ULL;
};

std::uint64_t hashOfRun(std::uint64_t seed, const std::function<void(Simulation&, int)>& meddle) {
  Simulation simulation(room(), testRobot(), small(seed));
  Hash hash;
  for (int i = 0; i < 300; ++i) {
    simulation.command({0.4, 0.1 * std::sin(0.02 * i), 0.2});
    meddle(simulation, i);
    hash.add(simulation.step());
  }
  return hash.value();
}

TEST(Simulation, IsTheSameBitByBitForTheSameSeed) {
  const auto nothing = [](Simulation&, int) {};
  const auto meddle = [](Simulation& simulation, int tick) {
    if (tick == 50) simulation.fail("all", FaultKind::kCorrupt, 0.5, 0.5);
    if (tick == 150) simulation.fail("camera", FaultKind::kDelay, 0.2, 0.0);
    if (tick == 200) simulation.place("box", {1.5, 0.0, 0.2});
  };
  EXPECT_EQ(hashOfRun(7, nothing), hashOfRun(7, nothing));
  EXPECT_NE(hashOfRun(7, nothing), hashOfRun(8, nothing));
  EXPECT_EQ(hashOfRun(7, meddle), hashOfRun(7, meddle));
  EXPECT_NE(hashOfRun(7, meddle), hashOfRun(7, nothing));
}

TEST(Simulation, DeliversEachSensorAtItsRateWithTheTimeOfItsMeasurement) {
  Simulation simulation(room(), testRobot(), small(1));
  int depth = 0, colour = 0, odometry = 0, imu = 0, front = 0, joints = 0;
  for (int i = 0; i < 1000; ++i) {
    const Readings& readings = simulation.step();
    ASSERT_NEAR(readings.time, 0.01 * (i + 1), 1e-9);
    depth += readings.depth ? 1 : 0;
    colour += readings.colour ? 1 : 0;
    odometry += readings.odometry ? 1 : 0;
    imu += readings.imu ? 1 : 0;
    joints += readings.joints ? 1 : 0;
    ASSERT_EQ(readings.ranges.size(), 2U);
    front += readings.ranges[0] ? 1 : 0;
    if (readings.depth) {
      ASSERT_EQ(readings.depth->stamp, readings.time);
      ASSERT_EQ(readings.depth->value->millimetres.size(), 160U * 120U);
    }
  }
  EXPECT_EQ(depth, 300);
  EXPECT_EQ(colour, 150);
  EXPECT_EQ(odometry, 500);
  EXPECT_EQ(imu, 1000);
  EXPECT_EQ(joints, 500);
  EXPECT_EQ(front, 200);
}

TEST(Simulation, NeverChangesAnImageThatSomebodyHolds) {
  Simulation simulation(room(), testRobot(), small(1));
  std::vector<std::shared_ptr<const DepthImage>> held;
  std::vector<std::vector<std::uint16_t>> copies;
  for (int i = 0; i < 100; ++i) {
    simulation.command({0.4, 0.0, 0.5});
    const Readings& readings = simulation.step();
    if (!readings.depth) continue;
    held.push_back(readings.depth->value);
    copies.push_back(held.back()->millimetres);
  }
  ASSERT_EQ(held.size(), 30U);
  for (std::size_t i = 0; i < held.size(); ++i) EXPECT_EQ(held[i]->millimetres, copies[i]);
}

TEST(Simulation, SeesABoxWhereItWasPlaced) {
  SimulationParameters parameters = small(1);
  parameters.sensors.depth_rate = parameters.sensors.colour_rate = 0.0;
  World world = room();
  world.start = {};
  Simulation simulation(world, testRobot(), parameters);
  EXPECT_EQ(simulation.place("box", {1.0, 0.0, 0.0}), std::nullopt);
  EXPECT_NEAR(simulation.freeDistance().distance, 1.0 - 0.15 - 0.25, 1e-4);
  EXPECT_NEAR(simulation.freeAlong({0.3, 0.0, 0.0}).distance, 0.6, 1e-3);
  EXPECT_EQ(simulation.nameOf(simulation.freeDistance().model), "box");
  EXPECT_EQ(simulation.place("robot", {-1.0, 0.0, 0.0}), std::nullopt);
  EXPECT_NEAR(simulation.freeDistance().distance, 1.6, 1e-3);
  EXPECT_NEAR(simulation.base().pose().x, -1.0, 1e-9);
  EXPECT_EQ(simulation.place("walker", {1.0, 3.0, 0.0}), std::nullopt);
  for (int i = 0; i < 100; ++i) simulation.step();
  EXPECT_NEAR(simulation.scene().pose(3).translation().x(), 1.0, 1e-9) << "it stands there";
}

TEST(Simulation, SaysWhyItDoesNotPlaceOrFail) {
  Simulation simulation(room(), testRobot(), small(1));
  EXPECT_NE(simulation.place("sofa", {})->find("\"sofa\""), std::string::npos);
  EXPECT_NE(simulation.place("box", {std::nan(""), 0.0, 0.0})->find("not finite"),
            std::string::npos);
  EXPECT_NE(simulation.fail("nose", FaultKind::kDrop, 0.0, 0.0)->find("expected all, camera"),
            std::string::npos);
  EXPECT_NE(simulation.fail("camera", FaultKind::kDrop, 2.0, 0.0)->find("amount is 2"),
            std::string::npos);
  EXPECT_NE(simulation.fail("camera", FaultKind::kDelay, 5.1, 0.0)->find("expected 0 to 5"),
            std::string::npos)
      << "every picture under way takes memory";
  EXPECT_NE(simulation.fail("camera", FaultKind::kDrop, 0.0, -1.0)->find("seconds is -1"),
            std::string::npos);
}

TEST(Simulation, FailsItsSensorsOnDemand) {
  Simulation simulation(room(), testRobot(), small(1));
  const auto count = [&](int ticks) {
    std::array<int, 3> counts{};
    for (int i = 0; i < ticks; ++i) {
      const Readings& readings = simulation.step();
      counts[0] += readings.depth ? 1 : 0;
      counts[1] += readings.odometry ? 1 : 0;
      counts[2] += readings.ranges[1] ? 1 : 0;
    }
    return counts;
  };
  EXPECT_TRUE(simulation.sensors().failing(simulation.time()).empty());
  simulation.fail("camera", FaultKind::kDrop, 0.0, 1.0);
  EXPECT_EQ(simulation.sensors().failing(simulation.time()), std::vector<std::string>{"camera"});
  EXPECT_EQ(count(100), (std::array<int, 3>{1, 50, 20})) << "the fault ends at its last tick";
  EXPECT_EQ(count(100)[0], 30);
  simulation.fail("all", FaultKind::kDrop, 0.0, 0.0);
  EXPECT_EQ(count(100), (std::array<int, 3>{0, 0, 0}));
  simulation.fail("all", FaultKind::kNone, 0.0, 0.0);
  EXPECT_EQ(count(100), (std::array<int, 3>{30, 50, 20}));
  simulation.fail("odometry", FaultKind::kCorrupt, 0.0, 0.0);
  for (int i = 0; i < 100; ++i) {
    const Readings& readings = simulation.step();
    if (!readings.odometry) continue;
    const auto& [pose, twist] = readings.odometry->value;
    const double sum = pose.x + pose.y + pose.heading + twist.vx + twist.vy + twist.w;
    ASSERT_FALSE(std::abs(sum) < 1e6);
  }
}

TEST(Simulation, MakesOdometrySayThatADrivenRobotStands) {
  Simulation simulation(room(), testRobot(), small(1));
  std::optional<Reading<OdometryReading>> last, stands;
  for (int i = 0; i < 100; ++i) {
    if (i == 70) simulation.fail("odometry", FaultKind::kStand, 0.0, 0.0);
    simulation.command({0.0, 0.0, 0.5});
    auto& newest = i < 70 ? last : stands;
    if (const auto& odometry = simulation.step().odometry) newest = odometry;
  }
  EXPECT_GT(last->value.twist.w, 0.2);
  EXPECT_EQ(stands->value.pose.heading, last->value.pose.heading);
  EXPECT_TRUE(stands->value.twist.zero());
  EXPECT_NEAR(stands->stamp, 1.0, 1e-9);
}

TEST(Simulation, StartsInTheClearInEveryWorldOfMaps) {
  SimulationParameters parameters = small(1);
  parameters.sensors.depth_rate = parameters.sensors.colour_rate = 0.0;
  int worlds = 0;
  for (const auto& entry : std::filesystem::directory_iterator(PILOTHOUSE_SOURCE "/maps")) {
    if (entry.path().extension() != ".sdf") continue;
    const auto loaded = loadWorld(entry.path().string());
    ASSERT_TRUE(loaded) << loaded.reason();
    Simulation simulation(loaded->world, testRobot(), parameters);
    EXPECT_GT(simulation.freeDistance().distance, 0.1) << entry.path();
    EXPECT_FALSE(simulation.base().dropped()) << entry.path();
    EXPECT_NEAR(simulation.base().T_world_base().translation().z(), 0.0, 0.05) << entry.path();
    ++worlds;
  }
  EXPECT_GE(worlds, 8);
}

// Driven at random by somebody blind, it bumps into much and goes through nothing.
TEST(Simulation, NeverGoesThroughWhatStandsInRandomWorlds) {
  SimulationParameters parameters = small(1);
  parameters.sensors.depth_rate = parameters.sensors.colour_rate = 0.0;
  std::size_t contacts = 0;
  for (std::uint64_t seed = 1; seed <= 9; ++seed) {
    RandomWorldParameters kind;
    kind.most_people = 0;  // they would walk into the robot
    Simulation simulation(randomWorld(seed, kind).world, testRobot(static_cast<BaseKind>(seed % 3)),
                          parameters);
    Random random(seed);
    Twist2 twist;
    for (int i = 0; i < 3000; ++i) {
      if (i % 150 == 0) {
        twist = {random.uniform(-0.3, 0.6), random.uniform(-0.3, 0.3), random.uniform(-1.0, 1.0)};
      }
      simulation.command(twist);
      simulation.step();
      const FreeWay nearest = simulation.freeDistance(0.05);
      ASSERT_GT(nearest.distance, -1e-6)
          << "seed " << seed << ": " << simulation.nameOf(nearest.model);
      ASSERT_FALSE(simulation.base().dropped()) << "seed " << seed;
    }
    contacts += simulation.base().contacts().size();
  }
  EXPECT_GT(contacts, 9U);
}

}  // namespace
}  // namespace pilothouse::sim
