// Dead reckoning, late matches, the gate, poses set by hand, gyroscope, time and odometry that
// jump.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/pose/pose_algebra.hpp"
#include "core/pose/pose_tracker.hpp"
#include "sim/random.hpp"

namespace pilothouse {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Drives straight on at 1 m/s from the origin, odometry 50 times a second.
void driveStraight(PoseTracker& tracker, double from, double to) {
  for (int i = static_cast<int>(std::lround(from * 50)); i <= std::lround(to * 50); ++i) {
    tracker.addOdometry(0.02 * i, {0.02 * i, 0.0, 0.0});
  }
}

ScanMatch matchAt(const Pose2& pose, double spread = 0.01) {
  ScanMatch match;
  match.found = true;
  match.pose = pose;
  match.covariance = Eigen::Matrix3d::Identity() * spread * spread;
  match.rms = 0.01;
  match.overlap = 0.9;
  return match;
}

PoseEstimate estimateAt(double stamp, const Pose2& pose, double spread = 0.1) {
  return {stamp, pose, Eigen::Matrix3d::Identity() * spread * spread};
}

double distance(const Pose2& a, const Pose2& b) {
  return (a.position() - b.position()).norm();
}

void expectNear(const Pose2& pose, const Pose2& expected, double tolerance) {
  EXPECT_NEAR(pose.x, expected.x, tolerance);
  EXPECT_NEAR(pose.y, expected.y, tolerance);
  EXPECT_NEAR(wrapped(pose.heading - expected.heading), 0.0, tolerance);
}

TEST(PoseTracker, FollowsOdometryAndGrowsUnsure) {
  PoseTracker tracker({});
  driveStraight(tracker, 0.0, 1.0);
  const double spread_after_1 = tracker.newest().covariance.trace();
  const double aside_after_1 = tracker.newest().covariance(1, 1);
  driveStraight(tracker, 1.02, 4.0);
  expectNear(tracker.newest().pose, {4.0, 0.0, 0.0}, 1e-9);
  expectNear(tracker.correction(), {}, 1e-9);
  EXPECT_GT(tracker.newest().covariance.trace(), 2.0 * spread_after_1);
  EXPECT_GT(tracker.newest().covariance(1, 1), 16.0 * aside_after_1)
      << "a wrong heading drives it sideways, the more the longer";
}

TEST(PoseTracker, LaysALateMatchUponItsOwnTime) {
  PoseTracker tracker({});
  driveStraight(tracker, 0.0, 2.0);
  // At 1.0 s it was 5 cm to the left, says a scan that took a second to be matched.
  const double before = tracker.newest().covariance(1, 1);
  ScanMatch match = matchAt({1.0, 0.05, 0.0}, 0.001);
  match.covariance(2, 2) = 0.04;  // and hardly anything of where it looked
  ASSERT_EQ(tracker.correct(1.0, match), MatchVerdict::kAccepted);
  const auto then = tracker.at(1.0);
  ASSERT_TRUE(then);
  EXPECT_NEAR(then->pose.y, 0.05, 0.005);
  EXPECT_NEAR(tracker.newest().pose.x, 2.0, 0.01) << "what was driven since counts";
  EXPECT_GT(tracker.newest().pose.y, 0.05) << "drifting left it is likely turned left";
  EXPECT_LT(tracker.newest().covariance(1, 1), before);
  // map -> odom takes odometry to the map.
  expectNear(composed(tracker.correction(), {2.0, 0.0, 0.0}), tracker.newest().pose, 1e-9);
}

TEST(PoseTracker, RefusesABadMatchAndStaysWhereItWas) {
  PoseTracker tracker({});
  driveStraight(tracker, 0.0, 1.0);
  const auto refusedAs = [&tracker](const ScanMatch& match) {
    const Pose2 before = tracker.newest().pose;
    const MatchVerdict verdict = tracker.correct(1.0, match);
    expectNear(tracker.newest().pose, before, 0.0);
    return verdict;
  };
  const Pose2 near{1.0, 0.01, 0.0};
  EXPECT_EQ(refusedAs({}), MatchVerdict::kNotFound);
  ScanMatch match = matchAt(near);
  match.rms = 0.2;
  EXPECT_EQ(refusedAs(match), MatchVerdict::kPoorFit);
  match = matchAt(near);
  match.overlap = 0.2;
  EXPECT_EQ(refusedAs(match), MatchVerdict::kLittleOverlap);
  match = matchAt(near);
  match.covariance(0, 0) = 4.0;
  EXPECT_EQ(refusedAs(match), MatchVerdict::kUncertain);
  match = matchAt({kNan, 0.0, 0.0});
  EXPECT_EQ(refusedAs(match), MatchVerdict::kNotFound);
  EXPECT_EQ(refusedAs(matchAt({1.0, 1.0, 0.0})), MatchVerdict::kUnlikely);
  EXPECT_GT(tracker.lastDistance(), TrackerParameters{}.gate);
  EXPECT_EQ(tracker.correct(-1.0, matchAt(near)), MatchVerdict::kNoTrack);
  EXPECT_EQ(tracker.correct(9.0, matchAt(near)), MatchVerdict::kNoTrack);
  EXPECT_EQ(tracker.correct(1.0, matchAt(near)), MatchVerdict::kAccepted) << "and takes a good one";
}

/// A robot that stands, 50 times a second, and a laser with ten scans a second, for some seconds.
/// @param match_at of the scan's index @return verdicts
template <class MatchAt>
std::vector<MatchVerdict> stand(PoseTracker& tracker, double from, double seconds,
                                const MatchAt& match_at) {
  std::vector<MatchVerdict> verdicts;
  for (int i = 1; i <= static_cast<int>(50.0 * seconds); ++i) {
    tracker.addOdometry(from + 0.02 * i, {1.0, 0.0, 0.0});
    if (i % 5 == 0) verdicts.push_back(tracker.correct(from + 0.02 * i, match_at(i / 5)));
  }
  return verdicts;
}

std::ptrdiff_t relocations(const std::vector<MatchVerdict>& verdicts) {
  return std::count(verdicts.begin(), verdicts.end(), MatchVerdict::kRelocated);
}

TEST(PoseTracker, BelievesWithinThreeSecondsThatSomebodyPushedIt) {
  PoseTracker tracker({});
  sim::Random random(4);
  driveStraight(tracker, 0.0, 1.0);
  const Pose2 pushed{1.2, 0.4, 0.3};
  const auto verdicts = stand(tracker, 1.0, 3.0, [&](int) {
    return matchAt({pushed.x + 0.01 * random.normal(), pushed.y + 0.01 * random.normal(),
                    pushed.heading + 0.005 * random.normal()});
  });
  EXPECT_EQ(relocations(verdicts), 1);
  EXPECT_EQ(verdicts.back(), MatchVerdict::kAccepted);
  expectNear(tracker.newest().pose, pushed, 0.03);
}

TEST(PoseTracker, NeverBelievesWrongMatchesThatAreAloneOrFew) {
  const Pose2 truth{1.0, 0.0, 0.0};
  sim::Random random(6);
  const auto anywhere = [&random] {
    return matchAt(
        {random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0)});
  };
  const auto run = [&truth](const auto& match_at) {
    PoseTracker tracker({});
    driveStraight(tracker, 0.0, 1.0);
    EXPECT_EQ(relocations(stand(tracker, 1.0, 30.0, match_at)), 0);
    expectNear(tracker.newest().pose, truth, 0.05);
  };
  // Each somewhere else.
  run([&](int) { return anywhere(); });
  // The same wrong one for more than a second and a half, again and again, with one right between.
  run([&](int i) { return matchAt(i % 17 == 0 ? truth : Pose2{1.0, 0.5, 0.2}); });
  // Half of them the same wrong one, the others anywhere.
  run([&](int i) { return i % 2 == 0 ? anywhere() : matchAt({1.0, 0.5, 0.2}); });
  // For good, but hardly half of the scan is found there.
  run([&](int) {
    ScanMatch match = matchAt({1.0, 0.5, 0.2});
    match.overlap = 0.5;
    return match;
  });
  // Seldom, however alike.
  PoseTracker tracker({});
  driveStraight(tracker, 0.0, 1.0);
  for (int i = 1; i <= 2000; ++i) {
    tracker.addOdometry(1.0 + 0.02 * i, truth);
    if (i % 100 != 0) continue;
    EXPECT_EQ(tracker.correct(1.0 + 0.02 * i, matchAt({1.0, 0.5, 0.2})), MatchVerdict::kUnlikely);
  }
}

TEST(PoseTracker, TrustsWheelsLessThatSlipAgainAndAgain) {
  // They count half as much again; each match is off by what they slipped since the one before.
  PoseTracker tracker({});
  int accepted = 0, all = 0;
  for (int i = 0; i <= 1000; ++i) {
    const double stamp = 0.02 * i, way = 0.6 * stamp;
    tracker.addOdometry(stamp, {1.5 * way, 0.0, 0.0});
    if (i % 5 != 0 || i == 0) continue;
    ++all;
    if (tracker.correct(stamp, matchAt({way, 0.0, 0.0}, 0.003)) == MatchVerdict::kAccepted)
      ++accepted;
  }
  EXPECT_GT(accepted, all * 8 / 10);
  EXPECT_NEAR(tracker.newest().pose.x, 12.0, 0.05);
}

TEST(PoseTracker, LearnsWhatTheWheelsMiscountAllTheTime) {
  // They count a tenth too much of the way and a fifth too much of each turn. While scans tell,
  // this is learnt; then for half a minute nothing is seen.
  PoseTracker tracker({});
  sim::Random random(8);
  Pose2 truth, wheels;
  for (int i = 1; i <= 50 * 60; ++i) {
    const double stamp = 0.02 * i;
    const Twist2 twist{0.3, 0.0, std::sin(0.3 * stamp)};
    const Pose2 step = advanced({}, twist, 0.02);
    truth = composed(truth, step);
    wheels = composed(wheels, {1.1 * step.x, 1.1 * step.y, 1.2 * step.heading});
    tracker.addOdometry(stamp, wheels);
    if (i % 5 != 0 || stamp > 30.0) continue;
    ScanMatch match = matchAt({truth.x + 0.01 * random.normal(), truth.y + 0.01 * random.normal(),
                               truth.heading + 0.005 * random.normal()});
    match.covariance(2, 2) = 0.005 * 0.005;
    EXPECT_EQ(tracker.correct(stamp, match), MatchVerdict::kAccepted) << stamp;
  }
  EXPECT_NEAR(tracker.scale().way(), 1.0 / 1.1, 0.02);
  EXPECT_NEAR(tracker.scale().turn(), 1.0 / 1.2, 0.02);
  const double raw = distance(wheels, truth);
  EXPECT_GT(raw, 0.5);
  EXPECT_LT(distance(tracker.newest().pose, truth), 0.2 * raw);
}

TEST(PoseTracker, LearnsNoScaleFromABaseThatCountedAnew) {
  PoseTracker tracker({});
  for (int i = 0; i <= 100; ++i) {
    const double stamp = 0.02 * i, way = 0.4 * stamp;
    // After a second it begins to count from elsewhere.
    tracker.addOdometry(stamp, {stamp > 1.0 ? way + 7.0 : way, 0.0, 0.0});
    if (i % 10 == 0) tracker.correct(stamp, matchAt({way, 0.0, 0.0}));
  }
  EXPECT_NEAR(tracker.scale().way(), 1.0, 0.02);
  expectNear(tracker.newest().pose, {0.8, 0.0, 0.0}, 0.02);
}

TEST(PoseTracker, TakesAPoseSetByHand) {
  PoseTracker tracker({});
  ASSERT_FALSE(tracker.setPose(estimateAt(0.0, {5.0, 5.0, 1.0}))) << "before any odometry";
  tracker.addOdometry(0.0, {1.0, 2.0, 0.0});
  expectNear(tracker.newest().pose, {5.0, 5.0, 1.0}, 1e-9);
  driveStraight(tracker, 1.0, 3.0);
  const auto epoch = tracker.epoch();
  // Set for 2.0 s: what it drove since is added.
  ASSERT_FALSE(tracker.setPose(estimateAt(2.0, {-3.0, 0.0, 1.5707963267948966})));
  expectNear(tracker.newest().pose, {-3.0, 1.0, 1.5707963267948966}, 1e-6);
  EXPECT_NE(tracker.epoch(), epoch) << "matches begun before are void";
  EXPECT_FALSE(tracker.at(1.0)) << "scans from before belong to the pose that was wrong";
  ASSERT_FALSE(tracker.setPose(estimateAt(99.0, {7.0, 0.0, 0.0}))) << "from ahead: now";
  expectNear(tracker.newest().pose, {7.0, 0.0, 0.0}, 1e-9);
}

TEST(PoseTracker, RefusesAPoseThatCannotBe) {
  PoseTracker tracker({});
  driveStraight(tracker, 0.0, 1.0);
  const auto refusal = [&tracker](const PoseEstimate& estimate) {
    const auto epoch = tracker.epoch();
    const auto reason = tracker.setPose(estimate);
    expectNear(tracker.newest().pose, {1.0, 0.0, 0.0}, 1e-9);
    EXPECT_EQ(tracker.epoch(), epoch);
    return reason.value_or("");
  };
  EXPECT_NE(refusal(estimateAt(1.0, {kNan, 0.0, 0.0})).find("not finite"), std::string::npos);
  EXPECT_NE(refusal(estimateAt(1.0, {1e9, 0.0, 0.0})).find("100 km"), std::string::npos);
  EXPECT_NE(refusal(estimateAt(1.0, {}, kNan)).find("covariance"), std::string::npos);
  EXPECT_NE(refusal(estimateAt(1.0, {}, 1e150)).find("100 km"), std::string::npos)
      << "sums of it would overflow";
  PoseEstimate estimate = estimateAt(1.0, {});
  estimate.covariance(0, 1) = 0.005;
  EXPECT_NE(refusal(estimate).find("not symmetric"), std::string::npos);
  estimate.covariance(0, 1) = estimate.covariance(1, 0) = 0.02;
  EXPECT_NE(refusal(estimate).find("not positive semidefinite"), std::string::npos);
  estimate.covariance.setZero();
  EXPECT_FALSE(tracker.setPose(estimate)) << "exactly known is possible";
}

TEST(PoseTracker, TurnsByTheGyroscopeWhereWheelsSlip) {
  PoseTracker by_wheels({}), with_gyro({});
  constexpr double kBias = 0.02;
  for (int i = 0; i <= 800; ++i) {
    const double stamp = 0.01 * i;
    // It stands for 3 s, then turns by 0.5 rad/s; the wheels count a fifth too much.
    const double rate = stamp > 3.0 ? 0.5 : 0.0;
    with_gyro.addGyro(stamp, rate + kBias);
    if (i % 2 != 0) continue;
    const Pose2 odometry{0.0, 0.0, wrapped(1.2 * 0.5 * std::max(0.0, stamp - 3.0))};
    by_wheels.addOdometry(stamp, odometry);
    with_gyro.addOdometry(stamp, odometry);
  }
  EXPECT_NEAR(wrapped(by_wheels.newest().pose.heading - 3.0), 0.0, 0.01);
  EXPECT_NEAR(wrapped(with_gyro.newest().pose.heading - 2.5), 0.0, 0.1);
  EXPECT_LT(with_gyro.newest().covariance(2, 2), by_wheels.newest().covariance(2, 2));
}

TEST(PoseTracker, LearnsTheGyroscopesConstantErrorOnTheWay) {
  // It never stands: only the wheels tell that it does not turn.
  PoseTracker tracker({});
  sim::Random random(5);
  constexpr double kBias = 0.01, kSeconds = 120.0;
  Pose2 odometry;
  for (int i = 0; i <= static_cast<int>(100 * kSeconds); ++i) {
    const double stamp = 0.01 * i;
    tracker.addGyro(stamp, kBias + 0.003 * random.normal());
    if (i % 2 != 0) continue;
    tracker.addOdometry(stamp, odometry);
    odometry = advanced(odometry, {0.5, 0.0, 0.02 * random.normal()}, 0.02);
  }
  // 69 degrees, if it were believed.
  EXPECT_NEAR(tracker.newest().pose.heading, 0.0, 0.1);
}

TEST(PoseTracker, BearsTimeRunningBack) {
  PoseTracker tracker({});
  driveStraight(tracker, 0.0, 2.0);
  ASSERT_EQ(tracker.correct(2.0, matchAt({2.0, 0.05, 0.0})), MatchVerdict::kAccepted);
  const Pose2 corrected = tracker.newest().pose;
  EXPECT_EQ(tracker.addOdometry(1.9, {2.0, 0.0, 0.0}), OdometryVerdict::kOld) << "a straggler";
  // The clock was set back under a standing robot: it is where it is.
  EXPECT_EQ(tracker.addOdometry(0.5, {2.0, 0.0, 0.0}), OdometryVerdict::kTimeBack);
  expectNear(tracker.newest().pose, corrected, 1e-9);
  EXPECT_FALSE(tracker.at(1.0));
  // A recording that begins anew puts it elsewhere.
  EXPECT_EQ(tracker.addOdometry(-5.0, {-7.0, 1.0, 0.0}), OdometryVerdict::kTimeBack);
  expectNear(tracker.newest().pose, {-7.0, 1.0, 0.0}, 1e-9);
  EXPECT_EQ(tracker.addOdometry(-4.98, {-6.98, 1.0, 0.0}), OdometryVerdict::kTaken);
}

TEST(PoseTracker, StaysInTheMapWhenTheBaseCountsAnew) {
  PoseTracker tracker({});
  driveStraight(tracker, 0.0, 2.0);
  EXPECT_EQ(tracker.addOdometry(2.02, {0.0, 0.0, 0.0}), OdometryVerdict::kJumped);
  expectNear(tracker.newest().pose, {2.0, 0.0, 0.0}, 1e-9);
  EXPECT_EQ(tracker.addOdometry(2.04, {0.02, 0.0, 0.0}), OdometryVerdict::kTaken);
  expectNear(tracker.newest().pose, {2.02, 0.0, 0.0}, 1e-9);
  // It counts anew where it had begun, but looks elsewhere: no base turns so fast.
  EXPECT_EQ(tracker.addOdometry(2.05, {0.02, 0.0, 2.5}), OdometryVerdict::kJumped);
  expectNear(tracker.newest().pose, {2.02, 0.0, 0.0}, 1e-9);
  EXPECT_EQ(tracker.addOdometry(2.06, {kNan, 0.0, 0.0}), OdometryVerdict::kNotFinite);
  EXPECT_EQ(tracker.addOdometry(kNan, {0.02, 0.0, 0.0}), OdometryVerdict::kNotFinite);
  expectNear(tracker.newest().pose, {2.02, 0.0, 0.0}, 1e-9);
}

TEST(TrackerParameters, NamesWhatIsOutOfRange) {
  TrackerParameters parameters;
  EXPECT_TRUE(validate(parameters).empty());
  parameters.gate = 0.0;
  parameters.widen_after = 0.0;
  const auto faults = validate(parameters);
  ASSERT_EQ(faults.size(), 2U);
  EXPECT_EQ(faults[0], "gate is 0, expected 1 to 1000");
}

}  // namespace
}  // namespace pilothouse
