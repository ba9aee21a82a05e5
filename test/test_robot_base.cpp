// The simulated base on worlds that are known exactly.
#include "sim/robot_base.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/actors.hpp"
#include "test/sim_worlds.hpp"

namespace pilothouse::sim {
namespace {

constexpr double kTick = 0.01;
const BaseNoise kNoSlip{0.0, 0.0, 0.0, 0.5};

/// A base in a world, stepped by hand.
class Drive {
 public:
  explicit Drive(const World& world, const SimRobot& robot = testRobot(),
                 const BaseNoise& noise = kNoSlip, std::uint64_t seed = 1)
      : scene(world), base(robot, noise, seed) {
    base.place(scene, {});
  }
  void step() {
    time += kTick;
    base.step(scene, time, kTick);
  }
  /// Commands anew at every tick.
  void hold(const Twist2& twist, double seconds) {
    for (int i = 0; i < static_cast<int>(seconds / kTick + 0.5); ++i) {
      base.command(twist, time);
      step();
    }
  }
  WorldScene scene;
  RobotBase base;
  double time = 0.0;
};

class EveryBase : public testing::TestWithParam<BaseKind> {};

TEST_P(EveryBase, DrivesAsToldAndKeepsItsLimits) {
  const SimRobot robot = testRobot(GetParam());
  Drive drive(flatWorld(), robot);
  Random random(4);
  for (int command = 0; command < 60; ++command) {
    const Twist2 twist{random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0),
                       random.uniform(-2.0, 2.0)};
    drive.base.place(drive.scene, {});
    for (int i = 0; i < 200; ++i) {
      drive.base.command(twist, drive.time);
      const Twist2 before = drive.base.twist();
      drive.step();
      const Twist2 change = drive.base.twist() - before;
      ASSERT_LE(drive.base.twist().linear(), robot.base.max_speed + 1e-9);
      ASSERT_LE(std::abs(drive.base.twist().w), robot.base.max_turn_rate + 1e-9);
      // Steered wheels that come round let the base catch up a little.
      ASSERT_LE(change.linear(), 1.3 * robot.base.acceleration * kTick) << i;
      ASSERT_LE(std::abs(change.w), 1.3 * robot.base.turn_acceleration * kTick);
    }
    const Twist2 wanted = withinLimits(twist, robot.base);
    EXPECT_NEAR(drive.base.twist().vx, wanted.vx, 1e-3);
    EXPECT_NEAR(drive.base.twist().vy, wanted.vy, 1e-3);
    EXPECT_NEAR(drive.base.twist().w, wanted.w, 1e-3);
  }
}

TEST_P(EveryBase, HaltsWhenCommandsStop) {
  const SimRobot robot = testRobot(GetParam());
  Drive drive(flatWorld(), robot);
  drive.hold({0.5, 0.0, 0.2}, 2.0);
  ASSERT_NEAR(drive.base.twist().vx, 0.5, 0.01);
  const double last = drive.time - kTick;
  double stands = 0.0;
  for (int i = 0; i < 200; ++i) {
    drive.step();
    const bool fresh = drive.time - last <= robot.base.command_timeout + 1e-6;
    if (fresh) {
      ASSERT_NEAR(drive.base.twist().vx, 0.5, 0.01) << "a single command lasts";
    }
    if (drive.base.twist().zero()) {
      stands = drive.time - last;
      break;
    }
  }
  const double brakes = 0.5 / robot.base.deceleration;
  EXPECT_GT(stands, robot.base.command_timeout);
  EXPECT_LT(stands, robot.base.command_timeout + brakes + 12.0 * robot.base.lag + 0.05);
}

TEST_P(EveryBase, BrakesOnItsArc) {
  Drive drive(flatWorld(), testRobot(GetParam()));
  drive.hold({0.4, 0.0, 0.8}, 2.0);
  while (!drive.base.twist().zero()) {
    if (drive.base.twist().vx > 0.01) {
      ASSERT_NEAR(drive.base.twist().w / drive.base.twist().vx, 2.0, 0.02);
    }
    drive.base.command({}, drive.time);
    drive.step();
    ASSERT_LT(drive.time, 10.0);
  }
}

TEST_P(EveryBase, LeavesOutCommandsThatAreNotFinite) {
  Drive drive(flatWorld(), testRobot(GetParam()));
  drive.hold({0.3, 0.0, 0.0}, 1.0);
  drive.hold({std::nan(""), 0.0, 0.0}, 2.0);
  EXPECT_TRUE(drive.base.twist().zero()) << "as if nothing came";
  EXPECT_TRUE(drive.base.pose().finite());
}

TEST_P(EveryBase, IsBlockedByABoxAndCountsOneContact) {
  World world = flatWorld();
  add(world, "box", boxMesh({0.3F, 0.3F, 0.18F}), at(1.0, 0.0));
  Drive drive(world, testRobot(GetParam()));
  drive.hold({0.5, 0.0, 0.0}, 6.0);
  EXPECT_NEAR(drive.base.pose().x, 1.0 - 0.15 - 0.25, 0.002);
  ASSERT_EQ(drive.base.contacts().size(), 1U);
  EXPECT_EQ(drive.base.contacts()[0].model, 1U);
  EXPECT_NEAR(drive.base.contacts()[0].robot_speed, 0.5, 0.05);
  EXPECT_EQ(drive.base.touching(), std::vector<std::size_t>{1});
  drive.hold({-0.3, 0.0, 0.0}, 2.0);
  EXPECT_LT(drive.base.pose().x, 0.3) << "it can back off";
  EXPECT_TRUE(drive.base.touching().empty());
  drive.hold({0.5, 0.0, 0.0}, 3.0);
  EXPECT_EQ(drive.base.contacts().size(), 2U) << "and touch it again";
}

TEST_P(EveryBase, PassesABoxThatIsBesideItsWay) {
  World world = flatWorld();
  add(world, "box", boxMesh({0.3F, 0.3F, 0.18F}), at(1.0, 0.36));
  Drive drive(world, testRobot(GetParam()));
  drive.hold({0.5, 0.0, 0.0}, 6.0);
  EXPECT_GT(drive.base.pose().x, 2.0);
  EXPECT_TRUE(drive.base.contacts().empty());
}

TEST_P(EveryBase, DrivesOverASillAndUnderATable) {
  World world = flatWorld();
  add(world, "sill", boxMesh({0.1F, 4.0F, 0.03F}), at(1.0, 0.0));
  add(world, "table", boxMesh({0.8F, 4.0F, 0.05F}), at(2.0, 0.0, 0.8));
  Drive drive(world, testRobot(GetParam()));
  double highest = 0.0;
  for (int i = 0; i < 800; ++i) {
    drive.hold({0.5, 0.0, 0.0}, kTick);
    highest = std::max(highest, drive.base.T_world_base().translation().z());
  }
  EXPECT_GT(drive.base.pose().x, 3.0);
  EXPECT_TRUE(drive.base.contacts().empty());
  EXPECT_GT(highest, 0.005) << "the sill lifts it";
  EXPECT_NEAR(drive.base.T_world_base().translation().z(), 0.0, 1e-6);
}

TEST_P(EveryBase, IsTiltedByARamp) {
  World world = flatWorld();
  const double slope = std::tan(10.0 * 3.14159265 / 180.0);
  addRamp(world, 0.6, slope, 4.0);
  Drive drive(world, testRobot(GetParam()));
  drive.hold({0.5, 0.0, 0.0}, 5.0);
  EXPECT_TRUE(drive.base.contacts().empty());
  const double x = drive.base.pose().x;
  ASSERT_GT(x, 1.4);
  EXPECT_LT(x, 0.5 * 5.0) << "a way uphill is shorter seen from above";
  EXPECT_NEAR(drive.base.T_world_base().translation().z(), slope * (x - 0.6), 0.005);
  const Eigen::Vector3d forward = drive.base.T_world_base().linear().col(0);
  EXPECT_NEAR(std::asin(forward.z()) * 180.0 / 3.14159265, 10.0, 0.2);
}

TEST_P(EveryBase, FindsTheDropAndStaysThere) {
  Drive drive(flatWorld(1.0), testRobot(GetParam()));
  drive.hold({0.5, 0.0, 0.0}, 6.0);
  ASSERT_EQ(drive.base.contacts().size(), 1U);
  EXPECT_EQ(drive.base.contacts()[0].model, kNoModel);
  EXPECT_TRUE(drive.base.dropped());
  EXPECT_LT(drive.base.pose().x, 1.0);
  const double x = drive.base.pose().x;
  drive.hold({-0.5, 0.0, 0.0}, 1.0);
  EXPECT_EQ(drive.base.pose().x, x) << "nobody drives out of a fall";
  drive.base.place(drive.scene, {});
  EXPECT_FALSE(drive.base.dropped());
}

TEST_P(EveryBase, StepsDownNoDeeperThanItsWheelsCan) {
  World world = flatWorld(1.0);
  add(world, "lower", boxMesh({40.0F, 40.0F, 1.0F}), at(21.0, 0.0, -1.03));
  Drive drive(world, testRobot(GetParam()));
  drive.hold({0.5, 0.0, 0.0}, 6.0);
  EXPECT_TRUE(drive.base.contacts().empty());
  EXPECT_NEAR(drive.base.T_world_base().translation().z(), -0.03, 1e-6);
}

// Parts of a world meet within rounding: a wheel does not fall through the slit that is left.
TEST_P(EveryBase, BridgesSlits) {
  for (const double heading : {0.0, 0.5 * 3.14159265358979}) {
    World world = flatWorld(0.9);
    add(world, "beyond", boxMesh({40.0F, 40.0F, 1.0F}), at(20.905, 0.0, -1.0));
    Drive drive(world, testRobot(GetParam()));
    // Slowly, and turned by 90 degrees along the slit as well: wheels' middles come to lie in it.
    drive.base.place(drive.scene, {0.0, 0.0, 0.0});
    if (heading != 0.0) drive.base.place(drive.scene, {0.9025 - 0.17, 0.0, heading});
    drive.hold({0.1, 0.0, 0.0}, 14.0);
    EXPECT_FALSE(drive.base.dropped()) << heading;
    EXPECT_GT(drive.base.pose().x + drive.base.pose().y, 1.3);
    EXPECT_NEAR(drive.base.T_world_base().translation().z(), 0.0, 1e-6);
  }
}

INSTANTIATE_TEST_SUITE_P(Three, EveryBase,
                         testing::Values(BaseKind::kFourWheelSteered, BaseKind::kDifferential,
                                         BaseKind::kOmnidirectional));

TEST(RobotBase, SlipsByItsSeed) {
  const BaseNoise noise;
  const auto end = [&](std::uint64_t seed) {
    Drive drive(flatWorld(), testRobot(), noise, seed);
    drive.hold({0.5, 0.0, 0.1}, 10.0);
    return drive.base.pose();
  };
  const Pose2 first = end(1), again = end(1), other = end(2);
  EXPECT_EQ(first.x, again.x);
  EXPECT_EQ(first.heading, again.heading);
  EXPECT_NE(first.x, other.x);
  EXPECT_NEAR(first.x, other.x, 0.2);
}

TEST(RobotBase, TellsWhoRanIntoWhom) {
  World world = flatWorld();
  add(world, "walker", boxMesh({0.3F, 0.3F, 1.7F}), at(3.0, 0.0));
  world.models.back().path = ActorPath{{{0.0, {3.0, 0.0, 0.0}}, {5.0, {-2.0, 0.0, 0.0}}}, false};
  Drive drive(world);
  Actors actors(world);
  for (int i = 0; i < 600; ++i) {
    actors.step(drive.scene, {drive.base.robot().footprint, drive.base.pose(), drive.base.twist()},
                kTick);
    drive.scene.commit();
    drive.step();
  }
  ASSERT_EQ(drive.base.contacts().size(), 1U);
  EXPECT_EQ(drive.base.contacts()[0].model, 1U);
  EXPECT_EQ(drive.base.contacts()[0].robot_speed, 0.0) << "the robot stood";
}

TEST(Actors, HaltForTheRobotWhenCourteous) {
  World world = flatWorld();
  add(world, "walker", boxMesh({0.3F, 0.3F, 1.7F}), at(3.0, 0.0));
  world.models.back().path = ActorPath{{{0.0, {3.0, 0.0, 0.0}}, {5.0, {-2.0, 0.0, 0.0}}}, false};
  world.models.back().courtesy = 0.5;
  Drive drive(world);
  Actors actors(world);
  for (int i = 0; i < 400; ++i) {
    actors.step(drive.scene, {drive.base.robot().footprint, drive.base.pose(), drive.base.twist()},
                kTick);
  }
  const double gap = drive.scene.pose(1).translation().x() - 0.25;
  EXPECT_GT(gap, 0.5);
  EXPECT_LT(gap, 1.0);
  for (int i = 0; i < 600; ++i) {
    actors.step(drive.scene, {drive.base.robot().footprint, {0.0, 3.0, 0.0}, {}}, kTick);
  }
  EXPECT_NEAR(drive.scene.pose(1).translation().x(), -2.0, 1e-6) << "and go on when it is gone";
}

TEST(Actors, TurnRoundWhenTheyHaveWaitedLong) {
  World world = flatWorld();
  add(world, "walker", boxMesh({0.3F, 0.3F, 1.7F}), at(3.0, 0.0));
  world.models.back().path = ActorPath{{{0.0, {3.0, 0.0, 0.0}}, {5.0, {-2.0, 0.0, 0.0}}}, false};
  world.models.back().courtesy = 0.5;
  Drive drive(world);
  Actors actors(world);
  double farthest_back = 0.0;
  for (int i = 0; i < 1000; ++i) {
    actors.step(drive.scene, {drive.base.robot().footprint, drive.base.pose(), drive.base.twist()},
                kTick);
    if (i > 400) farthest_back = std::max(farthest_back, drive.scene.pose(1).translation().x());
    EXPECT_GT(drive.scene.pose(1).translation().x() - 0.25, 0.5);
  }
  EXPECT_GT(farthest_back, 2.0);
}

TEST(Actors, DoNotWaitWhereTheRobotComes) {
  World world = flatWorld();
  add(world, "walker", boxMesh({0.3F, 0.3F, 1.7F}), at(3.0, 0.0));
  world.models.back().path = ActorPath{{{0.0, {3.0, 0.0, 0.0}}, {5.0, {-2.0, 0.0, 0.0}}}, false};
  world.models.back().courtesy = 0.5;
  const SimRobot robot = testRobot();
  WorldScene scene(world);
  Actors actors(world);
  Pose2 pose;
  const Twist2 creeping{0.1, 0.0, 0.0};
  for (int i = 0; i < 1500; ++i) {
    actors.step(scene, {robot.footprint, pose, creeping}, kTick);
    pose = advanced(pose, creeping, kTick);
    ASSERT_GT(scene.pose(1).translation().x() - 0.15 - (pose.x + 0.25), 0.2) << i;
  }
}

TEST(Surroundings, MeasureTheFreeWay) {
  World world = flatWorld();
  add(world, "box", boxMesh({0.2F, 0.2F, 0.5F}), at(1.35, 0.1));
  add(world, "low", boxMesh({0.2F, 0.2F, 0.04F}), at(0.6, 0.0));
  add(world, "lamp", boxMesh({0.2F, 0.2F, 0.1F}), at(0.6, 0.0, 0.8));
  const WorldScene scene(world);
  const SimRobot robot = testRobot();
  Surroundings around;
  around.collect(scene, robot, at(0.0, 0.0), 3.0);
  EXPECT_NEAR(around.nearest(robot.footprint).distance, 1.0, 1e-3);
  EXPECT_EQ(around.nearest(robot.footprint).model, 1U);
  EXPECT_NEAR(around.along(robot.footprint, {0.3, 0.0, 0.0}, 3.0).distance, 1.0, 1e-3);
  EXPECT_EQ(around.along(robot.footprint, {-0.3, 0.0, 0.0}, 3.0).model, kNoModel);
  EXPECT_EQ(around.along(robot.footprint, {}, 3.0).model, kNoModel);
  EXPECT_EQ(around.along(robot.footprint, {0.3, 0.0, 0.0}, 0.9).model, kNoModel);
  // Turning in place, the left side meets the post's near edge.
  World post = flatWorld();
  add(post, "post", boxMesh({0.02F, 0.02F, 1.0F}), at(0.0, 0.3));
  const WorldScene posted(post);
  around.collect(posted, robot, at(0.0, 0.0), 3.0);
  const double turn = std::atan2(0.29, 0.01) - std::asin(0.2 / std::hypot(0.29, 0.01));
  EXPECT_NEAR(around.along(robot.footprint, {0.0, 0.0, 1.0}, 3.0).distance,
              turn * std::hypot(0.25, 0.2), 0.002);
}

}  // namespace
}  // namespace pilothouse::sim
