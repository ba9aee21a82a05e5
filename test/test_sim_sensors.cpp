// Rangers, odometry, inertial sensor and faults by themselves, against what is known exactly.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sim/fault.hpp"
#include "sim/imu.hpp"
#include "sim/odometry.hpp"
#include "sim/ranger.hpp"
#include "sim/robot_base.hpp"
#include "test/sim_worlds.hpp"

namespace pilothouse::sim {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
const RangerNoise kQuiet{0.0, 0.0, 30.0};

double rangeIn(const World& world, const Eigen::Isometry3d& T_world_base,
               const RangerNoise& noise = kQuiet) {
  const WorldScene scene(world);
  return Ranger(testRobot().rangers[0], noise, 1).measure(scene, T_world_base);
}

TEST(Ranger, MeasuresAWallAndHearsNothingFromTheFloor) {
  World world = flatWorld();
  EXPECT_EQ(rangeIn(world, at(0.0, 0.0)), kInfinity) << "a bare floor";
  add(world, "wall", boxMesh({0.1F, 4.0F, 2.0F}), at(2.05, 0.0));
  EXPECT_NEAR(rangeIn(world, at(0.0, 0.0)), 1.75, 1e-4);
  EXPECT_EQ(rangeIn(world, at(-2.0, 0.0)), kInfinity) << "farther than it can";
  EXPECT_EQ(rangeIn(world, at(1.74, 0.0)), -kInfinity) << "nearer than it can";
  EXPECT_EQ(rangeIn(world, at(0.0, 0.0, 0.0, 3.14159265)), kInfinity) << "the other way";
}

TEST(Ranger, HearsTheNearestEchoOfItsCone) {
  World world = flatWorld();
  add(world, "wall", boxMesh({0.1F, 4.0F, 2.0F}), at(2.55, 0.0));
  // Its near edge is 1.0 m ahead and 0.2 m aside: within 15 degrees.
  add(world, "post", boxMesh({0.1F, 0.1F, 1.0F}), at(1.3, 0.25));
  EXPECT_NEAR(rangeIn(world, at(0.0, 0.0)), std::hypot(1.0, 0.2), 0.03);
  // 0.4 m aside it lies beyond the cone.
  world.models.pop_back();
  add(world, "post", boxMesh({0.1F, 0.1F, 1.0F}), at(1.3, 0.45));
  EXPECT_NEAR(rangeIn(world, at(0.0, 0.0)), 2.25, 1e-4);
}

TEST(Ranger, HearsNoWallThatIsStruckFlatly) {
  World world = flatWorld();
  add(world, "wall", boxMesh({10.0F, 0.1F, 2.0F}), at(0.0, 0.35));
  EXPECT_EQ(rangeIn(world, at(0.0, 0.0)), kInfinity);
  World slanted = flatWorld();
  add(slanted, "wall", boxMesh({0.1F, 10.0F, 2.0F}), at(1.3, 0.0, 0.0, 0.5));
  EXPECT_LT(rangeIn(slanted, at(0.0, 0.0)), 1.1);
}

TEST(Ranger, HearsGlass) {
  World world = flatWorld();
  add(world, "pane", boxMesh({0.1F, 4.0F, 2.0F}), at(1.3, 0.0));
  world.models.back().parts[0].material.glass = true;
  EXPECT_NEAR(rangeIn(world, at(0.0, 0.0)), 1.0, 1e-4);
}

TEST(Ranger, IsNoisyBySeed) {
  World world = flatWorld();
  add(world, "wall", boxMesh({0.1F, 4.0F, 2.0F}), at(1.3, 0.0));
  const WorldScene scene(world);
  RangerNoise noise;
  noise.drop_out = 0.1;
  Ranger one(testRobot().rangers[0], noise, 5), same(testRobot().rangers[0], noise, 5);
  double sum = 0.0, squares = 0.0;
  int heard = 0, lost = 0;
  for (int i = 0; i < 2000; ++i) {
    const double range = one.measure(scene, at(0.0, 0.0));
    ASSERT_EQ(range, same.measure(scene, at(0.0, 0.0)));
    if (!std::isfinite(range)) {
      ++lost;
      continue;
    }
    ++heard;
    sum += range - 1.0;
    squares += (range - 1.0) * (range - 1.0);
  }
  EXPECT_NEAR(sum / heard, 0.0, 0.001);
  EXPECT_NEAR(std::sqrt(squares / heard), noise.spread, 0.0005);
  EXPECT_NEAR(lost, 200, 60);
}

class Drift : public testing::TestWithParam<BaseKind> {};

// The bound that sim/odometry.hpp states: a few percent of the way. Five, for 20 seeds.
TEST_P(Drift, StaysWithinAFewPercentOfTheWay) {
  const WorldScene scene(flatWorld());
  const SimRobot robot = testRobot(GetParam());
  double worst = 0.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    RobotBase base(robot, {}, mixSeed(seed, 1));
    Odometry odometry(robot.base, {}, mixSeed(seed, 2));
    base.place(scene, {});
    double way = 0.0;
    for (int i = 1; i <= 3000; ++i) {
      base.command({0.5, 0.0, 0.25 * std::sin(0.004 * i)}, 0.01 * i);
      base.step(scene, 0.01 * i, 0.01);
      odometry.step(base.drive().wheels(), 0.01);
      way += base.twist().linear() * 0.01;
    }
    const Pose2& seen = odometry.reading().pose;
    const double off = (seen.position() - base.pose().position()).norm();
    EXPECT_GT(off, 1e-4 * way) << "slip must show";
    EXPECT_LT(off, 0.05 * way) << "seed " << seed;
    EXPECT_LT(std::abs(wrapped(seen.heading - base.pose().heading)), 0.15) << "seed " << seed;
    worst = std::max(worst, off / way);
  }
  RecordProperty("worst_percent", std::to_string(100.0 * worst));
}

INSTANTIATE_TEST_SUITE_P(Three, Drift,
                         testing::Values(BaseKind::kFourWheelSteered, BaseKind::kDifferential,
                                         BaseKind::kOmnidirectional));

TEST(Odometry, StandsStillWithTheRobot) {
  Odometry odometry(testRobot().base, {}, 1);
  for (int i = 0; i < 1000; ++i) odometry.step({}, 0.01);
  EXPECT_EQ(odometry.reading().pose.x, 0.0);
  EXPECT_TRUE(odometry.reading().twist.zero());
}

TEST(Imu, FeelsGravityTurningAndAcceleration) {
  Imu imu({0.0, 0.0, 0.0, 0.0}, 1);
  const Eigen::Isometry3d rest = at(1.0, 2.0, 0.0, 0.7);
  for (int i = 0; i < 3; ++i) imu.step(rest, 0.01);
  EXPECT_NEAR((imu.reading().acceleration - Eigen::Vector3d(0, 0, 9.81)).norm(), 0.0, 1e-9);
  EXPECT_NEAR(imu.reading().rate.norm(), 0.0, 1e-9);
  Imu turning({0.0, 0.0, 0.0, 0.0}, 1), speeding({0.0, 0.0, 0.0, 0.0}, 1);
  for (int i = 0; i < 5; ++i) {
    turning.step(at(0.0, 0.0, 0.0, 0.5 * 0.01 * i), 0.01);
    speeding.step(at(0.0, 0.5 * 0.6 * (0.01 * i) * (0.01 * i), 0.0, 1.570796326795), 0.01);
  }
  EXPECT_NEAR(turning.reading().rate.z(), 0.5, 1e-6);
  EXPECT_NEAR(speeding.reading().acceleration.x(), 0.6, 1e-6) << "forward of the robot";
  Imu tilted({0.0, 0.0, 0.0, 0.0}, 1);
  Eigen::Isometry3d uphill = Eigen::Isometry3d::Identity();
  uphill.linear() = Eigen::AngleAxisd(-0.2, Eigen::Vector3d::UnitY()).toRotationMatrix();
  for (int i = 0; i < 3; ++i) tilted.step(uphill, 0.01);
  EXPECT_NEAR(tilted.reading().acceleration.x(), 9.81 * std::sin(0.2), 1e-6);
}

/// A sensor that counts, ten times a second.
class Counter {
 public:
  Counter() : channel(1, [](int& value, Random&) { value = -1; }) {}
  /// Everything that arrives within `seconds`, as (arrival, stamp, value).
  std::vector<std::array<double, 3>> run(double seconds) {
    std::vector<std::array<double, 3>> arrived;
    for (int i = 0; i < static_cast<int>(seconds * 10.0 + 0.5); ++i) {
      now += 0.1;
      channel.offer(now, [this] { return ++measured; });
      while (auto reading = channel.take(now)) {
        arrived.push_back({now, reading->stamp, static_cast<double>(reading->value)});
      }
    }
    return arrived;
  }
  SensorChannel<int> channel;
  double now = 0.0;
  int measured = 0;
};

TEST(Fault, NoneLetsAllThrough) {
  Counter counter;
  const auto arrived = counter.run(1.0);
  ASSERT_EQ(arrived.size(), 10U);
  EXPECT_EQ(arrived[4][2], 5.0);
  EXPECT_EQ(arrived[4][0], arrived[4][1]);
}

TEST(Fault, FreezeRepeatsTheLastValueWithNewStamps) {
  Counter counter;
  counter.run(0.5);
  counter.channel.fail({FaultKind::kFreeze});
  const auto arrived = counter.run(1.0);
  ASSERT_EQ(arrived.size(), 10U);
  EXPECT_EQ(counter.measured, 5) << "nothing is measured in vain";
  for (const auto& a : arrived) {
    EXPECT_EQ(a[2], 5.0);
    EXPECT_EQ(a[0], a[1]);
  }
}

TEST(Fault, DropLosesAllOrAShare) {
  Counter counter;
  counter.channel.fail({FaultKind::kDrop});
  EXPECT_TRUE(counter.run(5.0).empty());
  counter.channel.fail({FaultKind::kDrop, 0.25});
  EXPECT_NEAR(static_cast<double>(counter.run(100.0).size()), 750.0, 60.0);
}

TEST(Fault, DelayKeepsTheStamps) {
  Counter counter;
  counter.channel.fail({FaultKind::kDelay, 0.35});
  const auto arrived = counter.run(2.0);
  ASSERT_GT(arrived.size(), 10U);
  for (const auto& a : arrived) EXPECT_NEAR(a[0] - a[1], 0.4, 1e-6);
}

TEST(Fault, HealedDelayIsOverAtOnce) {
  Counter counter;
  counter.channel.fail({FaultKind::kDelay, 1.0});
  counter.run(3.0);
  counter.channel.fail({});
  auto arrived = counter.run(2.0);
  ASSERT_EQ(arrived.size(), 20U) << "what was under way is lost";
  for (const auto& a : arrived) EXPECT_EQ(a[0], a[1]);

  counter.channel.fail({FaultKind::kDelay, 1.0, counter.now + 3.05});
  counter.run(3.0);
  arrived = counter.run(2.0);
  ASSERT_EQ(arrived.size(), 20U) << "ended by itself";
  for (const auto& a : arrived) EXPECT_EQ(a[0], a[1]);
}

TEST(Fault, AShorterDelayHoldsAtOnce) {
  Counter counter;
  counter.channel.fail({FaultKind::kDelay, 2.0});
  counter.run(3.0);
  counter.channel.fail({FaultKind::kDelay, 0.2});
  const auto arrived = counter.run(2.0);
  ASSERT_EQ(arrived.size(), 18U);
  for (const auto& a : arrived) EXPECT_NEAR(a[0] - a[1], 0.2, 1e-6);
}

TEST(Fault, CorruptSpoilsAShareAndNotWhatIsKept) {
  Counter counter;
  counter.channel.fail({FaultKind::kCorrupt, 0.5});
  int spoilt = 0;
  for (const auto& a : counter.run(100.0)) spoilt += a[2] == -1.0 ? 1 : 0;
  EXPECT_NEAR(spoilt, 500, 60);
}

TEST(Fault, EndsByItself) {
  Counter counter;
  counter.channel.fail({FaultKind::kDrop, 0.0, 1.05});
  const auto arrived = counter.run(2.0);
  ASSERT_EQ(arrived.size(), 10U);
  EXPECT_NEAR(arrived[0][0], 1.1, 1e-6);
}

}  // namespace
}  // namespace pilothouse::sim
