// How late a scanner's stamps are, learnt from the robot's own motion.
#include <gtest/gtest.h>

#include <cmath>

#include "core/pose/pose_algebra.hpp"
#include "core/pose/scan_lag.hpp"
#include "sim/random.hpp"

namespace pilothouse {
namespace {

constexpr double kTick = 0.02;  // [s]

/// Where a robot is that drives and turns by turns, or steadily.
Pose2 poseAt(double stamp, bool steady) {
  Pose2 pose;
  for (double t = 0.0; t < stamp; t += kTick) {
    const double beat = steady ? 1.0 : 0.5 + 0.5 * std::sin(2.0 * t);
    pose = advanced(pose, {0.5 * beat, 0.0, 0.4 * beat}, std::min(kTick, stamp - t));
  }
  return pose;
}

ScanMatch matchAt(const Pose2& pose) {
  ScanMatch match;
  match.found = true;
  match.pose = pose;
  match.covariance = Eigen::Vector3d(2.5e-5, 2.5e-5, 4e-6).asDiagonal();
  return match;
}

/// Ten matches a second, stamped `late`, for some seconds. @param drift of odometry, of its way
void drive(ScanLag& lag, double late, double seconds, bool steady, double drift = 0.0) {
  sim::Random random(3);
  Pose2 odometry, before;
  std::vector<std::pair<double, Pose2>> ways;
  for (int i = 0; i <= std::lround(seconds / kTick); ++i) {
    const double stamp = kTick * i;
    const Pose2 truth = poseAt(stamp, steady), step = relative(before, truth);
    odometry = composed(odometry, {(1.0 + drift) * step.x, step.y, (1.0 + drift) * step.heading});
    before = truth;
    ways.emplace_back(stamp, odometry);
    if (i % 5 != 0 || stamp < 0.5) continue;
    // What the tracker does: the lag comes off first.
    const double used = stamp - 0.2;
    const Pose2 seen = poseAt(used + lag.seconds() - late, steady);
    const Pose2 matched{seen.x + 0.005 * random.normal(), seen.y + 0.005 * random.normal(),
                        seen.heading + 0.002 * random.normal()};
    std::vector<std::pair<double, Pose2>> lately;
    for (const auto& entry : ways) {
      if (entry.first >= used - ScanLag::kWay - kTick && entry.first <= used + kTick) {
        lately.push_back(entry);
      }
    }
    lag.learn(used, matchAt(matched), lately);
  }
}

TEST(ScanLag, FindsHowLateTheStampsAre) {
  for (const double late : {0.07, -0.03, 0.0}) {
    ScanLag lag;
    drive(lag, late, 20.0, false, 0.03);
    EXPECT_NEAR(lag.seconds(), late, 0.008);
    EXPECT_LT(lag.spread(), 0.015);
  }
}

TEST(ScanLag, LearnsNothingOfASteadyDrive) {
  ScanLag lag;
  drive(lag, 0.07, 20.0, true);
  EXPECT_NEAR(lag.seconds(), 0.0, 0.01);
  EXPECT_GT(lag.spread(), 0.04) << "and knows that it does not know";
}

TEST(ScanLag, StaysWithinItsBoundsAndBearsNonsense) {
  ScanLag lag;
  drive(lag, 0.4, 20.0, false);
  EXPECT_LE(lag.seconds(), ScanLag::kMost);
  const double before = lag.seconds();
  lag.learn(100.0, matchAt({NAN, 0.0, 0.0}), {{99.9, {}}, {100.0, {1.0, 0.0, 0.0}}});
  lag.learn(101.0, matchAt({}), {});
  lag.learn(102.0, matchAt({}), {{102.0, {}}});
  // A match that went to the next room says nothing of the lag.
  lag.learn(103.0, matchAt({}), {{102.9, {}}, {103.0, {0.1, 0.0, 0.0}}});
  lag.learn(103.6, matchAt({9.0, 3.0, 1.0}), {{103.5, {0.3, 0.0, 0.0}}, {103.6, {0.4, 0.0, 0.0}}});
  EXPECT_EQ(lag.seconds(), before);
}

}  // namespace
}  // namespace pilothouse
