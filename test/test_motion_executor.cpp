// The executor drives simple simulated bases along routes.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sim/random.hpp"
#include "test/simulated_base.hpp"

namespace pilothouse {
namespace {

using Eigen::Vector2d;
using Points = std::vector<Vector2d>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Distance of a point from the polyline.
double offLegs(const Vector2d& p, const Points& points) {
  double least = kInfinity;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Vector2d leg = points[i] - points[i - 1];
    const double share =
        std::clamp(leg.dot(p - points[i - 1]) / std::max(1e-12, leg.squaredNorm()), 0.0, 1.0);
    least = std::min(least, (p - points[i - 1] - share * leg).norm());
  }
  return least;
}

struct Drive {
  std::vector<Pose2> track;
  ExecutorOutput last;
  double seconds = 0.0;
  double farthest_off = 0.0;  ///< from the legs [m]
  double fastest = 0.0;       ///< [m/s]

  double passed(const Vector2d& point) const {
    double least = kInfinity;
    for (const auto& pose : track) least = std::min(least, (pose.position() - point).norm());
    return least;
  }
};

/// Drives until it says reached and stands, or the time is up.
Drive drive(MotionExecutor& executor, SimulatedBase& robot, const BaseParameters& base,
            Points points, std::optional<double> heading, double seconds) {
  Drive drive;
  executor.drive(points, heading, false, robot.pose());
  points.insert(points.begin(), robot.pose().position());
  Twist2 wanted;
  for (int i = 0; i * kStep < seconds; ++i) {
    if (i % 2 == 0) {
      ExecutorInput input;
      input.now = i * kStep;
      input.pose = robot.pose();
      drive.last = executor.step(input);
      wanted = drive.last.wanted;
      EXPECT_TRUE(wanted.finite());
      EXPECT_LE(wanted.linear(), base.max_speed);
      EXPECT_LE(std::abs(wanted.w), base.max_turn_rate);
      if (base.kind == BaseKind::kDifferential) {
        EXPECT_EQ(wanted.vy, 0.0);
      }
    }
    robot.step(wanted);
    drive.track.push_back(robot.pose());
    drive.farthest_off = std::max(drive.farthest_off, offLegs(robot.pose().position(), points));
    drive.fastest = std::max(drive.fastest, robot.twist().linear());
    drive.seconds = i * kStep;
    const bool stands = robot.twist().linear() < 1e-4 && std::abs(robot.twist().w) < 1e-4;
    if (drive.last.state == ExecutorState::kReached && stands) break;
  }
  return drive;
}

class EachBase : public testing::TestWithParam<std::tuple<BaseKind, HeadingMode>> {
 protected:
  const BaseParameters base_ = baseOf(std::get<0>(GetParam()));
  ExecutorParameters parameters() const {
    ExecutorParameters p;
    p.heading = std::get<1>(GetParam());
    return p;
  }
};

TEST_P(EachBase, ReachesTheEndOfRandomRoutesInTheirOrderWithoutCuttingCorners) {
  sim::Random random(7);
  double worst_off = 0.0, worst_end = 0.0, worst_turn = 0.0;
  for (int run = 0; run < 60; ++run) {
    Points points;
    for (int i = random.integer(1, 6); i > 0; --i) {
      points.emplace_back(random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0));
    }
    const Pose2 start{random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0),
                      random.uniform(-3.1, 3.1)};
    const bool with_heading = random.chance(0.5);
    const double heading = random.uniform(-3.1, 3.1);
    MotionExecutor executor(parameters(), base_);
    SimulatedBase robot(base_, start);
    const Drive done = drive(executor, robot, base_, points,
                             with_heading ? std::optional<double>(heading) : std::nullopt, 240.0);
    SCOPED_TRACE("run " + std::to_string(run));
    ASSERT_EQ(done.last.state, ExecutorState::kReached);
    const double end = (robot.pose().position() - points.back()).norm();
    EXPECT_LE(end, 0.03);
    if (with_heading) {
      const double turn = std::abs(wrapped(robot.pose().heading - heading));
      EXPECT_LE(turn, 0.035);
      worst_turn = std::max(worst_turn, turn);
    }
    for (const auto& point : points) {
      EXPECT_LE(done.passed(point), parameters().corners.max_cut + 0.05);
    }
    EXPECT_LE(done.farthest_off, parameters().corners.max_cut + 0.08);
    EXPECT_EQ(done.last.target, points.size() - 1);
    EXPECT_EQ(done.last.distance_left, 0.0);
    worst_off = std::max(worst_off, done.farthest_off);
    worst_end = std::max(worst_end, end);
  }
  RecordProperty("worst_off_mm", static_cast<int>(1e3 * worst_off));
  std::printf("off the legs %.3f m, off the end %.3f m and %.2f deg\n", worst_off, worst_end,
              worst_turn * 57.3);
}

TEST_P(EachBase, StopsAtTheEndWithoutOvershoot) {
  MotionExecutor executor(parameters(), base_);
  SimulatedBase robot(base_, {});
  const Drive done = drive(executor, robot, base_, {{3.0, 0.0}}, std::nullopt, 60.0);
  double farthest = 0.0;
  for (const auto& pose : done.track) farthest = std::max(farthest, pose.x);
  EXPECT_LE(farthest, 3.02);
  EXPECT_GT(done.fastest, 0.9 * std::min(base_.max_speed, parameters().limits.max_speed));
}

/// Drives at top speed; a new route is made for where it is then and comes `delay` later.
/// @return how long it took from when the new route was made [s].
double driveOnWithLateOrder(MotionExecutor& executor, const BaseParameters& base, double delay,
                            double bend) {
  SimulatedBase robot(base, {});
  executor.drive({{0, 0}, {6, 0}}, std::nullopt, false, robot.pose());
  const Vector2d along(std::cos(bend), std::sin(bend));
  Points route;
  double made = 0.0, farthest = -kInfinity, back = 0.0;
  bool sent = false;
  ExecutorOutput output;
  for (double now = 0.0; now < 90.0; now += kStep) {
    if (route.empty() && robot.pose().x > 1.5) {
      made = now;
      for (int i = 0; i < 6; ++i) route.push_back(robot.pose().position() + 0.8 * i * along);
    }
    if (!route.empty() && !sent && now >= made + delay - 1e-9) {
      executor.drive(route, std::nullopt, false, robot.pose());
      sent = true;
    }
    ExecutorInput input;
    input.now = now;
    input.pose = robot.pose();
    output = executor.step(input);
    robot.step(output.wanted);
    const double on = robot.pose().position().dot(along);
    farthest = std::max(farthest, on);
    back = std::max(back, farthest - on);
    if (sent && output.state == ExecutorState::kReached) {
      EXPECT_LE((robot.pose().position() - route.back()).norm(), 0.05);
      EXPECT_LE(back, 0.01) << "at a delay of " << delay << " s";
      return now - made;
    }
  }
  ADD_FAILURE() << "not reached at a delay of " << delay << " s";
  return kInfinity;
}

TEST_P(EachBase, ARouteThatComesLateDoesNotSendItBack) {
  for (const double bend : {0.0, 0.3}) {
    MotionExecutor executor(parameters(), base_);
    const double at_once = driveOnWithLateOrder(executor, base_, 0.0, bend);
    for (double delay = 0.05; delay < 0.41; delay += 0.05) {
      const double late = driveOnWithLateOrder(executor, base_, delay, bend);
      EXPECT_LE(late, at_once + delay + 0.1) << "at a delay of " << delay << " s";
    }
  }
}

TEST_P(EachBase, ARouteThatComesBackToItsBeginningIsNotCutShortThere) {
  MotionExecutor executor(parameters(), base_);
  // It is nearer to the leg back than to the one there.
  SimulatedBase robot(base_, {0.1, 0.03, 0.0});
  const Points there_and_back{{0, 0}, {0.3, 0}, {0, 0.04}, {-0.5, 0.04}};
  const Drive first = drive(executor, robot, base_, there_and_back, std::nullopt, 120.0);
  ASSERT_EQ(first.last.state, ExecutorState::kReached);
  EXPECT_LE(first.passed({0.3, 0}), 0.05);
  // Its beginning is crossed once more, later.
  SimulatedBase other(base_, {0.3, 0.0, 0.0});
  const Points eight{{0, 0}, {2, 0}, {2, 1}, {0.3, 1}, {0.3, -1}};
  const Drive second = drive(executor, other, base_, eight, std::nullopt, 120.0);
  ASSERT_EQ(second.last.state, ExecutorState::kReached);
  for (std::size_t i = 1; i < eight.size(); ++i) EXPECT_LE(second.passed(eight[i]), 0.15);
  for (const auto& pose : second.track) EXPECT_GE(pose.x, 0.15);
}

TEST_P(EachBase, ARouteThatBeginsElsewhereIsDrivenFromItsFirstPoint) {
  for (const Pose2 start : {Pose2{0.8, 0.0, 0.0}, Pose2{0.2, 0.3, 0.0}, Pose2{-0.4, 0.0, 0.0}}) {
    MotionExecutor executor(parameters(), base_);
    SimulatedBase robot(base_, start);
    const Drive done = drive(executor, robot, base_, {{0, 0}, {2, 0}}, std::nullopt, 120.0);
    ASSERT_EQ(done.last.state, ExecutorState::kReached);
    EXPECT_LE(done.passed({0, 0}), 0.15) << start.x << " " << start.y;
  }
}

TEST_P(EachBase, AFigureOfEightIsDrivenWholeAtItsCrossing) {
  MotionExecutor executor(parameters(), base_);
  SimulatedBase robot(base_, {});
  const Points points{{2, 2}, {2, 0}, {0, 2}, {-0.1, 0.1}, {-1.0, 0.1}};
  const Drive done = drive(executor, robot, base_, points, std::nullopt, 200.0);
  ASSERT_EQ(done.last.state, ExecutorState::kReached);
  for (const auto& point : points) EXPECT_LE(done.passed(point), 0.15);
}

TEST_P(EachBase, ThereAndBackOnOneLineTouchesTheFarEnd) {
  MotionExecutor executor(parameters(), base_);
  SimulatedBase robot(base_, {});
  const Drive done = drive(executor, robot, base_, {{2, 0}, {0, 0}}, std::nullopt, 120.0);
  ASSERT_EQ(done.last.state, ExecutorState::kReached);
  EXPECT_LE(done.passed({2, 0}), 0.03);
}

TEST_P(EachBase, ALoopIsDrivenRoundAndRound) {
  MotionExecutor executor(parameters(), base_);
  SimulatedBase robot(base_, {});
  const Points points{{1, 0}, {2, 1}, {1, 2}, {0, 1}};
  executor.drive(points, std::nullopt, true, robot.pose());
  std::vector<std::size_t> targets;
  for (int i = 0; i < 50 * 120; ++i) {
    ExecutorInput input;
    input.now = i * kStep;
    input.pose = robot.pose();
    const ExecutorOutput output = executor.step(input);
    ASSERT_EQ(output.state, ExecutorState::kDriving);
    if (targets.empty() || targets.back() != output.target) targets.push_back(output.target);
    robot.step(output.wanted);
  }
  ASSERT_GE(targets.size(), 12U);
  for (std::size_t i = 0; i < targets.size(); ++i) EXPECT_EQ(targets[i], i % 4);
}

TEST_P(EachBase, AfterAJumpItGoesOnAtTheNearestPlaceToCome) {
  MotionExecutor executor(parameters(), base_);
  SimulatedBase robot(base_, {});
  const Points points{{4, 0}, {4, 4}, {0, 4}};
  executor.drive(points, std::nullopt, false, robot.pose());
  std::size_t after_jump = 0;
  double now = 0.0;
  ExecutorOutput output;
  for (int i = 0; i < 50 * 200 && output.state != ExecutorState::kReached; ++i, now += kStep) {
    if (i == 200) robot.put({4.3, 1.5, 1.0});
    ExecutorInput input;
    input.now = now;
    input.pose = robot.pose();
    output = executor.step(input);
    if (i == 202) after_jump = output.target;
    robot.step(output.wanted);
  }
  EXPECT_EQ(after_jump, 1U);
  EXPECT_EQ(output.state, ExecutorState::kReached);
}

std::string nameOf(const testing::TestParamInfo<std::tuple<BaseKind, HeadingMode>>& info) {
  const char* kinds[] = {"steered", "differential", "omnidirectional"};
  const bool kept = std::get<1>(info.param) == HeadingMode::kKept;
  return std::string(kinds[static_cast<int>(std::get<0>(info.param))]) + (kept ? "_kept" : "");
}
INSTANTIATE_TEST_SUITE_P(
    Bases, EachBase,
    testing::Values(std::make_tuple(BaseKind::kFourWheelSteered, HeadingMode::kFree),
                    std::make_tuple(BaseKind::kFourWheelSteered, HeadingMode::kKept),
                    std::make_tuple(BaseKind::kDifferential, HeadingMode::kFree),
                    std::make_tuple(BaseKind::kOmnidirectional, HeadingMode::kFree),
                    std::make_tuple(BaseKind::kOmnidirectional, HeadingMode::kKept)),
    nameOf);

TEST(MotionExecutor, TurnsInPlaceFirstWhereTheRouteStartsBehind) {
  const BaseParameters base = baseOf(BaseKind::kDifferential);
  MotionExecutor executor({}, base);
  executor.drive({{-2, 0}}, std::nullopt, false, {});
  ExecutorInput input;
  const Twist2 wanted = executor.step(input).wanted;
  EXPECT_EQ(wanted.vx, 0.0);
  EXPECT_GT(std::abs(wanted.w), 0.3);
}

TEST(MotionExecutor, ABaseThatKeepsItsHeadingDrivesSidewaysWithoutTurning) {
  const BaseParameters base = baseOf(BaseKind::kOmnidirectional);
  ExecutorParameters parameters;
  parameters.heading = HeadingMode::kKept;
  MotionExecutor executor(parameters, base);
  SimulatedBase robot(base, {0.0, 0.0, 0.4});
  const Drive done = drive(executor, robot, base, {{0, 2}, {-2, 2}}, std::nullopt, 60.0);
  for (const auto& pose : done.track) EXPECT_NEAR(pose.heading, 0.4, 0.02);
}

TEST(MotionExecutor, WithoutARouteItWantsNothing) {
  MotionExecutor executor({}, baseOf(BaseKind::kDifferential));
  EXPECT_EQ(executor.step({}).state, ExecutorState::kIdle);
  executor.drive({{1, 0}}, std::nullopt, false, {});
  executor.cancel();
  EXPECT_EQ(executor.step({}).state, ExecutorState::kIdle);
  EXPECT_TRUE(executor.step({}).wanted.zero());
}

TEST(MotionExecutor, NoRouteAndNoPoseMakesItWantMoreThanTheBaseCan) {
  sim::Random random(11);
  for (int run = 0; run < 300; ++run) {
    const BaseParameters base = baseOf(static_cast<BaseKind>(random.integer(0, 2)));
    MotionExecutor executor({}, base);
    Points points;
    for (int i = random.integer(0, 20); i > 0; --i) {
      const double size = random.chance(0.2) ? 1e-4 : random.chance(0.1) ? 1e4 : 2.0;
      points.emplace_back(random.uniform(-size, size), random.uniform(-size, size));
    }
    executor.drive(points, random.uniform(-9.0, 9.0), random.chance(0.5), {});
    for (int i = 0; i < 300; ++i) {
      ExecutorInput input;
      input.now = random.uniform(-1.0, 100.0);
      input.pose = {random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0),
                    random.uniform(-9.0, 9.0)};
      if (random.chance(0.02)) input.pose.x = std::nan("");
      input.hold = static_cast<Hold>(random.integer(0, 3));
      const ExecutorOutput output = executor.step(input);
      ASSERT_TRUE(output.wanted.finite());
      ASSERT_LE(output.wanted.linear(), base.max_speed);
      ASSERT_LE(std::abs(output.wanted.w), base.max_turn_rate);
      ASSERT_TRUE(std::isfinite(output.distance_left));
      ASSERT_LT(output.target, std::max<std::size_t>(1, points.size()));
    }
  }
}

TEST(MotionExecutor, EveryParameterIsHeldToItsRange) {
  ExecutorParameters sound;
  EXPECT_TRUE(validate(sound).empty());
  ExecutorParameters bad;
  bad.limits.max_speed = std::nan("");
  bad.looks = 101;
  ASSERT_EQ(validate(bad).size(), 2U);
  EXPECT_EQ(validate(bad)[0], "max_speed is nan, expected 0.02 to 10");
  EXPECT_EQ(validate(bad)[1], "looks is 101, expected 0 to 100");
  EXPECT_THROW(MotionExecutor(bad, baseOf(BaseKind::kDifferential)), std::invalid_argument);
}

}  // namespace
}  // namespace pilothouse
