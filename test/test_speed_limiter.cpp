// How fast the robot may go, and that nothing at all makes it break a limit.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/motion/kinematics.hpp"
#include "core/motion/power_limit.hpp"
#include "core/motion/speed_limiter.hpp"
#include "sim/random.hpp"

namespace pilothouse {
namespace {

using Eigen::Vector2d;

const Footprint& platform() {
  static const Footprint outline({{0.25, 0.20}, {-0.25, 0.20}, {-0.25, -0.20}, {0.25, -0.20}});
  return outline;
}

BaseParameters omnidirectional() {
  BaseParameters base;
  base.kind = BaseKind::kOmnidirectional;
  base.wheelbase = 0.4;
  return base;
}

Obstacle at(double x, double y, CellClass kind = CellClass::kObstacle) {
  Obstacle object;
  object.position = Eigen::Vector2f(static_cast<float>(x), static_cast<float>(y));
  object.size = 0.0F;
  object.kind = kind;
  return object;
}

Surroundings with(const std::vector<Obstacle>& objects) {
  Surroundings surroundings;
  surroundings.sources.push_back({"camera", 0.0});
  surroundings.objects = objects;
  return surroundings;
}

TEST(PowerLimit, IsTheOriginalsFormula) {
  EXPECT_EQ(powerLimit(0.0, 2.0, 1.0), 0.0);
  EXPECT_EQ(powerLimit(-1.0, 2.0, 1.0), 0.0);
  EXPECT_EQ(powerLimit(std::nan(""), 1.0, 1.0), 0.0);
  EXPECT_NEAR(powerLimit(0.5, 2.0, 3.0), 0.75, 1e-12);
  EXPECT_EQ(powerLimit(5.0, 2.0, 3.0), 1.0);
}

TEST(BrakingBound, StopsWithinTheDistance) {
  for (const double distance : {0.01, 0.1, 0.5, 2.0}) {
    const double v = brakingBound(distance, 0.2, 1.5);
    EXPECT_NEAR(v * 0.2 + v * v / (2.0 * 1.5), distance, 1e-12);
  }
  EXPECT_EQ(brakingBound(0.0, 0.2, 1.5), 0.0);
  EXPECT_EQ(brakingBound(std::nan(""), 0.2, 1.5), 0.0);
}

TEST(SpeedLimiter, AnObstacleInTheWayReachesZeroAtTheStopDistance) {
  SpeedLimiter limiter({}, omnidirectional(), platform());
  const double stop = limiter.parameters().stop_distance;
  double before = std::numeric_limits<double>::infinity();
  for (double gap = 1.5; gap >= 0.0; gap -= 0.05) {
    auto surroundings = with({at(0.25 + gap, 0.0)});
    const PathLimit limit = limiter.limitAlong({0.5, 0.0, 0.0}, surroundings, nullptr);
    EXPECT_LE(limit.speed, before) << gap;
    EXPECT_NEAR(limit.obstacle_distance, gap, 1e-6);
    EXPECT_EQ(surroundings.objects[0].relevance, Relevance::kInTheWay);
    if (gap <= stop) {
      EXPECT_EQ(limit.speed, 0.0) << gap;
    }
    if (gap > stop + 1e-6) {
      EXPECT_GT(limit.speed, 0.0) << gap;
    }
    before = limit.speed;
  }
}

TEST(SpeedLimiter, APotentialObstacleNeverStops) {
  SpeedLimiter limiter({}, omnidirectional(), platform());
  for (double x = 1.5; x >= -0.2; x -= 0.05) {
    auto surroundings = with({at(x, 0.30)});
    const PathLimit limit = limiter.limitAlong({0.5, 0.0, 0.0}, surroundings, nullptr);
    EXPECT_GE(limit.speed, limiter.parameters().beside_speed) << x;
    EXPECT_EQ(surroundings.objects[0].relevance, Relevance::kPotential) << x;
  }
  auto beside = with({at(0.1, 0.30)});
  const PathLimit limit = limiter.limitAlong({0.5, 0.0, 0.0}, beside, nullptr);
  EXPECT_NEAR(limit.speed, limiter.parameters().beside_speed, 1e-12);
  EXPECT_EQ(limit.cause, LimitCause::kPotential);
}

TEST(SpeedLimiter, TheLowerLimitWins) {
  SpeedLimiter limiter({}, omnidirectional(), platform());
  auto both = with({at(0.1, 0.30), at(0.25 + 0.26, 0.0)});
  const PathLimit limit = limiter.limitAlong({0.5, 0.0, 0.0}, both, nullptr);
  EXPECT_LT(limit.speed, limiter.parameters().beside_speed);
  EXPECT_NEAR(limit.distance, 0.26, 1e-6);
}

TEST(SpeedLimiter, AThresholdSlowsToItsSpeedAndNoMore) {
  SpeedLimiter limiter({}, omnidirectional(), platform());
  auto far = with({at(2.0, 0.0, CellClass::kThreshold)});
  auto near = with({at(0.25, 0.0, CellClass::kThreshold)});
  EXPECT_GT(limiter.limitAlong({0.5, 0.0, 0.0}, far, nullptr).speed, 0.5);
  const PathLimit limit = limiter.limitAlong({0.5, 0.0, 0.0}, near, nullptr);
  EXPECT_NEAR(limit.speed, limiter.parameters().threshold_speed, 1e-9);
  EXPECT_EQ(limit.cause, LimitCause::kThreshold);
  auto beside = with({at(0.25, 0.3, CellClass::kThreshold)});
  EXPECT_EQ(limiter.limitAlong({0.5, 0.0, 0.0}, beside, nullptr).cause, LimitCause::kFree);
}

TEST(SpeedLimiter, ADropOffStopsAsAnObstacleDoes) {
  SpeedLimiter limiter({}, omnidirectional(), platform());
  auto drop = with({at(0.40, 0.0, CellClass::kDropOff)});
  EXPECT_EQ(limiter.limitAlong({0.5, 0.0, 0.0}, drop, nullptr).speed, 0.0);
}

TEST(SpeedLimiter, UnseenGroundIsEnteredSlowlyOrNotAtAll) {
  const auto nothing = [](const Vector2d&) { return false; };
  const auto everything = [](const Vector2d&) { return true; };
  AvoidanceParameters parameters;
  SpeedLimiter limiter(parameters, omnidirectional(), platform());
  auto empty = with({});
  const PathLimit limit = limiter.limitAlong({-0.5, 0.0, 0.0}, empty, nothing);
  EXPECT_EQ(limit.cause, LimitCause::kUnseen);
  EXPECT_NEAR(limit.speed, parameters.unseen_speed, 1e-9);
  EXPECT_EQ(limiter.limitAlong({-0.5, 0.0, 0.0}, empty, everything).cause, LimitCause::kFree);
  parameters.unseen_speed = 0.0;
  limiter.setParameters(parameters);
  EXPECT_EQ(limiter.limitAlong({-0.5, 0.0, 0.0}, empty, nothing).speed, 0.0);
}

LimiterInput wanting(const Twist2& twist) {
  LimiterInput input;
  input.wanted = twist;
  input.measured.vx = std::nan("");  // no odometry: no trim
  return input;
}

TEST(SpeedLimiter, ThePathKeepsItsShapeWhenItIsSlowed) {
  SpeedLimiter limiter({}, omnidirectional(), platform());
  const Twist2 wanted{0.3, 0.1, 0.4};
  LimitedCommand out;
  for (int i = 0; i < 300; ++i) {
    auto surroundings = with({at(0.68, 0.16)});
    out = limiter.step(wanting(wanted), surroundings, nullptr);
    if (out.limited < 1e-6) continue;
    const double scale = out.command.vx / wanted.vx;
    EXPECT_NEAR(out.command.vy, scale * wanted.vy, 1e-9);
    EXPECT_NEAR(out.command.w, scale * wanted.w, 1e-9);
  }
  EXPECT_LT(out.limited, 0.9 * out.wanted);
  EXPECT_GT(out.limited, 0.0);
}

TEST(SpeedLimiter, StaleEyesOrOdometryStopAtOnce) {
  SpeedLimiter limiter({}, omnidirectional(), platform());
  auto empty = with({});
  const auto drive = [&] {
    LimitedCommand out;
    for (int i = 0; i < 200; ++i) out = limiter.step(wanting({0.4, 0.0, 0.0}), empty, nullptr);
    return out;
  };
  EXPECT_NEAR(drive().limited, 0.4, 1e-6);
  for (const bool eyes : {true, false}) {
    drive();
    LimiterInput input = wanting({0.4, 0.0, 0.0});
    (eyes ? input.perception_age : input.odometry_age) = 0.31;
    const LimitedCommand out = limiter.step(input, empty, nullptr);
    EXPECT_TRUE(out.command.zero());
    EXPECT_EQ(out.limit.cause, LimitCause::kStale);
  }
  drive();
  LimiterInput input = wanting({0.4, 0.0, 0.0});
  input.perception_age = std::nan("");
  EXPECT_TRUE(limiter.step(input, empty, nullptr).command.zero()) << "unknown means stop";
}

TEST(SpeedLimiter, ASilentCommandRunsOut) {
  SpeedLimiter limiter({}, omnidirectional(), platform());
  auto empty = with({});
  for (int i = 0; i < 200; ++i) limiter.step(wanting({0.4, 0.0, 0.0}), empty, nullptr);
  LimiterInput input = wanting({0.4, 0.0, 0.0});
  input.command_age = 0.31;
  LimitedCommand out;
  for (int i = 0; i < 100; ++i) out = limiter.step(input, empty, nullptr);
  EXPECT_TRUE(out.command.zero());
}

TEST(SpeedLimiter, GoesOnOnlyWhenThereIsSomeWayAgain) {
  SpeedLimiter limiter({}, omnidirectional(), platform());
  const double stop = limiter.parameters().stop_distance;
  const auto limited = [&](double gap) {
    auto surroundings = with({at(0.25 + gap, 0.0)});
    return limiter.step(wanting({0.4, 0.0, 0.0}), surroundings, nullptr).limit.speed;
  };
  EXPECT_EQ(limited(stop + 0.005), 0.0);
  EXPECT_EQ(limited(stop + 0.04), 0.0) << "no dithering at the edge";
  EXPECT_GT(limited(stop + 0.15), 0.0);
}

TEST(SpeedRegulator, KeepsAccelerationAndJerk) {
  AvoidanceParameters parameters;
  SpeedRegulator regulator(parameters, 0.32);
  Twist2 last{}, last_change{};
  const double dt = 0.02;
  for (int i = 0; i < 400; ++i) {
    const Twist2 target = i < 200 ? Twist2{0.5, 0.0, 0.0} : Twist2{-0.3, 0.0, 0.0};
    const Twist2 next = regulator.approach(target, dt);
    const Twist2 out = regulator.finish(next, std::abs(next.vx), 10.0, std::nan(""), dt);
    const double change = (out.vx - last.vx) / dt;
    EXPECT_LE(std::abs(change), parameters.acceleration + 1e-9) << i;
    EXPECT_LE(std::abs(change - last_change.vx) / dt, 2.0 * parameters.jerk + 1e-6) << i;
    last = out;
    last_change.vx = change;
    if (i == 199) {
      EXPECT_NEAR(out.vx, 0.5, 1e-9);
    }
  }
  EXPECT_NEAR(last.vx, -0.3, 1e-9);
}

TEST(SpeedRegulator, ThePidHoldsTheMeasuredSpeedAndDoesNotWindUp) {
  AvoidanceParameters parameters;
  SpeedRegulator regulator(parameters, 0.32);
  const double dt = 0.02;
  double speed = 0.0;
  for (int i = 0; i < 800; ++i) {  // a base that goes 10 % slower than it is told
    const Twist2 next = regulator.approach({0.4, 0.0, 0.0}, dt);
    const Twist2 out = regulator.finish(next, next.vx, 10.0, speed, dt);
    speed += (0.9 * out.vx - speed) * 0.2;
  }
  EXPECT_NEAR(speed, 0.4, 0.004);
  for (int i = 0; i < 2000; ++i) {  // held by something: the integral must not fill
    const Twist2 next = regulator.approach({0.4, 0.0, 0.0}, dt);
    regulator.finish(next, next.vx, 10.0, 0.0, dt);
  }
  double most = 0.0;
  for (int i = 0; i < 500; ++i) {
    const Twist2 next = regulator.approach({0.4, 0.0, 0.0}, dt);
    const Twist2 out = regulator.finish(next, next.vx, 10.0, speed, dt);
    speed += (out.vx - speed) * 0.2;
    most = std::max(most, speed);
  }
  EXPECT_LE(most, 0.4 * 1.2 + 1e-9);
  EXPECT_NEAR(speed, 0.4, 0.01);
}

TEST(SpeedRegulator, ANoisyMeasurementDoesNotSpurTheBase) {
  const AvoidanceParameters parameters;
  SpeedRegulator regulator(parameters, 0.32);
  sim::Random random(3);
  const double dt = 0.02;
  double last = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const Twist2 next = regulator.approach({0.5, 0.0, 0.0}, dt);
    const double measured = last + (random.chance(0.3) ? random.uniform(-0.5, 0.5) : 0.0);
    const Twist2 out = regulator.finish(next, next.vx, 10.0, measured, dt);
    // The command's own acceleration and that of the trim.
    EXPECT_LE((out.vx - last) / dt, 2.0 * parameters.acceleration + 1e-9) << i;
    last = out.vx;
  }
}

TEST(SpeedLimiter, TurningInPlaceBrakesWithWhatTheBaseTurnsWith) {
  AvoidanceParameters parameters;
  parameters.k = 20.0;  // the power limit out of the way
  BaseParameters base = omnidirectional();
  base.turn_acceleration = 1.0;
  SpeedLimiter limiter(parameters, base, platform());
  auto near = with({at(0.0, 0.30)});
  const PathLimit limit = limiter.limitAlong({0.0, 0.0, 1.0}, near, nullptr);
  EXPECT_EQ(limit.cause, LimitCause::kBraking);
  const double reach = std::hypot(0.25, 0.20);
  const double turn = limit.obstacle_distance / 0.30 - parameters.turn_clearance / 0.30;
  const double w = limit.speed / reach;  // what it may turn with
  EXPECT_NEAR(w * parameters.latency + w * w / (2.0 * base.turn_acceleration), turn, 1e-6);
}

/// A number of any kind: usual, huge, none at all.
double wild(sim::Random& random) {
  switch (random.integer(0, 9)) {
    case 0:
      return std::nan("");
    case 1:
      return random.chance(0.5) ? HUGE_VAL : -HUGE_VAL;
    case 2:
      return random.uniform(-1e300, 1e300);
    case 3:
      return 0.0;
    default:
      return random.uniform(-2.0, 2.0);
  }
}

double wildStep(sim::Random& random) {
  switch (random.integer(0, 9)) {
    case 0:
      return std::nan("");
    case 1:
      return -random.uniform(0.0, 1.0);
    case 2:
      return 0.0;
    case 3:
      return 10.0;
    default:
      return random.uniform(0.001, 0.1);
  }
}

TEST(SpeedLimiter, TenMillionRandomStepsBreakNoLimit) {
  constexpr long kSteps = 10000000;
  const std::uint64_t seed = 20261122;
  sim::Random random(seed);
  const BaseParameters base = omnidirectional();
  SpeedLimiter limiter({}, base, platform());
  const double kTiny = 1e-9;
  for (long i = 0; i < kSteps; ++i) {
    LimiterInput input;
    input.wanted = {wild(random), wild(random), wild(random)};
    input.measured = {wild(random), wild(random), wild(random)};
    input.dt = wildStep(random);
    input.command_age = random.chance(0.9) ? 0.05 : wild(random);
    input.odometry_age = random.chance(0.95) ? 0.02 : wild(random);
    input.perception_age = random.chance(0.95) ? 0.05 : wild(random);
    Surroundings surroundings = with({});
    const int objects = random.integer(0, 3);
    for (int k = 0; k < objects; ++k) {
      surroundings.objects.push_back(
          at(random.chance(0.05) ? wild(random) : random.uniform(-2, 2), random.uniform(-1, 1),
             random.chance(0.2) ? CellClass::kThreshold : CellClass::kObstacle));
    }
    const LimitedCommand out = limiter.step(input, surroundings, nullptr);
    ASSERT_TRUE(out.command.finite()) << "step " << i;
    ASSERT_LE(out.command.linear(), base.max_speed + kTiny) << "step " << i;
    ASSERT_LE(std::abs(out.command.w), base.max_turn_rate + kTiny) << "step " << i;
    ASSERT_LE(out.limited, out.limit.speed + kTiny) << "step " << i;
    const bool blind =
        !(input.perception_age <= 0.3) || !(input.odometry_age <= 0.3) || !input.wanted.finite();
    if (blind) {
      ASSERT_TRUE(out.command.zero()) << "step " << i;
    }
  }
}

}  // namespace
}  // namespace pilothouse
