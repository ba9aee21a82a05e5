// Scans laid upon what was met before and upon a given map: how well, how sure, and when not.
#include <gtest/gtest.h>

#include <cmath>

#include "core/pose/pose_algebra.hpp"
#include "core/pose/scan_localiser.hpp"
#include "core/pose/scan_points.hpp"
#include "registration/icp_matcher.hpp"
#include "sim/random.hpp"
#include "test/segment_room.hpp"

namespace pilothouse {
namespace {

std::vector<Eigen::Vector2d> pointsFrom(const SegmentRoom& room, const Pose2& pose,
                                        sim::Random& random) {
  const auto still = [&pose](double) { return pose; };
  return pointsOf(room.scan(still, 0.0, 0.0, random), {}, TrackPiece({{0.0, Pose2{}}}), 0.0);
}

ScanLocaliser localiser(const LocaliserParameters& parameters = {}) {
  return ScanLocaliser(parameters, std::make_unique<IcpMatcher>());
}

/// A guess that may be half a metre off.
PoseEstimate about(const Pose2& pose) {
  return {0.0, pose, Eigen::Matrix3d::Identity() * 0.04};
}

double distance(const Pose2& a, const Pose2& b) {
  return (a.position() - b.position()).norm();
}

TEST(ScanLocaliser, FindsWhereAScanWasTaken) {
  const SegmentRoom room = SegmentRoom::furnished();
  sim::Random random(1);
  ScanLocaliser scans = localiser();
  EXPECT_FALSE(scans.match(pointsFrom(room, {}, random), about({})).found) << "there is no map yet";
  scans.learn(MatchVerdict::kNotFound, {});
  for (int run = 0; run < 50; ++run) {
    const Pose2 truth{random.uniform(-0.6, 0.6), random.uniform(-0.6, 0.6),
                      random.uniform(-0.5, 0.5)};
    const Pose2 guess = composed(truth, {random.uniform(-0.15, 0.15), random.uniform(-0.15, 0.15),
                                         random.uniform(-0.1, 0.1)});
    const ScanMatch match = scans.match(pointsFrom(room, truth, random), about(guess));
    ASSERT_TRUE(match.found);
    EXPECT_LT(distance(match.pose, truth), 0.02) << run;
    EXPECT_NEAR(match.pose.heading, truth.heading, 0.01) << run;
    EXPECT_LT(match.rms, 0.03);
    EXPECT_GT(match.overlap, 0.75);
    EXPECT_LT(match.covariance.diagonal().maxCoeff(), 0.03 * 0.03);
  }
}

TEST(ScanLocaliser, SaysThatACorridorLeavesItsLengthOpen) {
  const SegmentRoom room = SegmentRoom::corridor();
  sim::Random random(2);
  ScanLocaliser scans = localiser();
  scans.match(pointsFrom(room, {}, random), about({}));
  scans.learn(MatchVerdict::kNotFound, {});
  const ScanMatch match = scans.match(pointsFrom(room, {0.0, 0.05, 0.0}, random), about({}));
  ASSERT_TRUE(match.found);
  EXPECT_NEAR(match.pose.y, 0.05, 0.02);
  EXPECT_GT(match.covariance(0, 0), 25.0 * match.covariance(1, 1));
}

TEST(ScanLocaliser, DoesNotFitAnotherRoom) {
  sim::Random random(3);
  ScanLocaliser scans = localiser();
  scans.match(pointsFrom(SegmentRoom::furnished(), {}, random), about({}));
  scans.learn(MatchVerdict::kNotFound, {});
  SegmentRoom other;
  other.box(-7.0, -1.2, 8.5, 2.4);
  const ScanMatch match = scans.match(pointsFrom(other, {}, random), about({}));
  const TrackerParameters limits;
  EXPECT_TRUE(!match.found || match.overlap < limits.min_overlap || match.rms > limits.max_rms)
      << match.overlap << " " << match.rms;
}

TEST(ScanLocaliser, FindsItselfInAGivenMap) {
  const SegmentRoom room = SegmentRoom::furnished();
  sim::Random random(4);
  MapCells map{-5.0, -4.0, 0.05, 200, 160, std::vector<MapCell>(200 * 160, MapCell::kUnknown)};
  for (const auto& segment : room.segments) {
    for (double share = 0.0; share <= 1.0; share += 0.002) {
      const Eigen::Vector2d place = segment.a + share * (segment.b - segment.a);
      map.cells[map.index(map.column(place.x()), map.row(place.y()))] = MapCell::kOccupied;
    }
  }
  ScanLocaliser scans = localiser();
  scans.give(edgesOf(map));
  const std::size_t mapped = scans.mapped();
  EXPECT_GT(mapped, 400U);
  for (int run = 0; run < 20; ++run) {
    const Pose2 truth{random.uniform(-1.0, 1.0), random.uniform(-1.0, 0.8),
                      random.uniform(-3.0, 3.0)};
    const Pose2 guess = composed(truth, {0.2, -0.15, 0.1});
    const ScanMatch match = scans.match(pointsFrom(room, truth, random), about(guess));
    ASSERT_TRUE(match.found);
    EXPECT_LT(distance(match.pose, truth), 0.05) << run;
    scans.learn(MatchVerdict::kAccepted, match.pose);
  }
  EXPECT_EQ(scans.mapped(), mapped) << "a given map stays as it was given";
}

TEST(ScanPoints, TakesOutWhatTheRobotMovedBetweenTheBeams) {
  const SegmentRoom room = SegmentRoom::furnished();
  sim::Random random(5);
  // A quick turn, 0.1 s a scan: 0.15 rad between the first beam and the last.
  const auto pose_at = [](double stamp) { return advanced({}, {0.5, 0.0, 1.5}, stamp); };
  const ScanBeams beams = room.scan(pose_at, 0.0, 0.1, random);
  const TrackPiece track({{0.0, pose_at(0.0)}, {0.05, pose_at(0.05)}, {0.1, pose_at(0.1)}});
  const auto points = pointsOf(beams, {}, track, beams.end());
  ScanLocaliser scans = localiser();
  scans.match(pointsFrom(room, {}, random), about({}));
  scans.learn(MatchVerdict::kNotFound, {});
  const Pose2 truth = pose_at(beams.end());
  const ScanMatch straightened = scans.match(points, about(truth));
  const ScanMatch skewed =
      scans.match(pointsOf(beams, {}, TrackPiece({{0.0, Pose2{}}}), beams.end()), about(truth));
  EXPECT_NEAR(wrapped(straightened.pose.heading - truth.heading), 0.0, 0.01);
  EXPECT_LT(straightened.rms, skewed.rms);
  EXPECT_GT(std::abs(wrapped(skewed.pose.heading - truth.heading)), 0.03);
}

TEST(ScanPoints, LeavesOutWhatIsNoMeasurementAndMindsTheMounting) {
  ScanBeams beams{0.0, 0.0, 1.5707963267948966, 0.0, 0.1, 10.0, {}};
  beams.ranges = {1.0F, 2.0F, NAN, INFINITY};
  const TrackPiece still({{0.0, Pose2{}}});
  const auto upright = pointsOf(beams, {{0.5, 0.0, 0.0}, false}, still, 0.0);
  ASSERT_EQ(upright.size(), 2U);
  EXPECT_NEAR((upright[0] - Eigen::Vector2d(1.5, 0.0)).norm(), 0.0, 1e-6);
  EXPECT_NEAR((upright[1] - Eigen::Vector2d(0.5, 2.0)).norm(), 0.0, 1e-6);
  const auto hanging = pointsOf(beams, {{0.5, 0.0, 0.0}, true}, still, 0.0);
  EXPECT_NEAR((hanging[1] - Eigen::Vector2d(0.5, -2.0)).norm(), 0.0, 1e-6);
  beams.ranges = {0.05F, 11.0F, -1.0F, -INFINITY};
  EXPECT_TRUE(pointsOf(beams, {}, still, 0.0).empty());
}

TEST(PointMap, KeepsItsBounds) {
  PointMapParameters parameters;
  parameters.most = 1000;
  PointMap map(parameters);
  sim::Random random(6);
  for (int i = 0; i < 50; ++i) {
    std::vector<Eigen::Vector2d> points;
    for (int k = 0; k < 200; ++k) {
      points.emplace_back(random.uniform(-20, 20), random.uniform(-20, 20));
    }
    map.add(points, {0.5 * i, 0.0, 0.0});
    ASSERT_LE(map.size(), 1000U);
  }
  EXPECT_GE(map.size(), 800U);
}

/// Drives loops in a room with odometry that turns too much; scans ten times a second.
TEST(ScanLocaliser, KeepsADriftingRobotNearTheTruth) {
  const SegmentRoom room = SegmentRoom::furnished();
  sim::Random random(7);
  PoseTracker tracker({});
  ScanLocaliser scans = localiser();
  Pose2 truth, odometry;
  double worst = 0.0;
  int accepted = 0;
  for (int i = 1; i <= 50 * 60; ++i) {
    const double stamp = 0.02 * i;
    truth = advanced(truth, {0.3, 0.0, 0.35}, 0.02);
    odometry = advanced(odometry, {0.3 * 1.01, 0.0, 0.35 * 1.02}, 0.02);
    ASSERT_EQ(tracker.addOdometry(stamp, odometry), OdometryVerdict::kTaken);
    if (i % 5 != 0) continue;
    const auto points = pointsFrom(room, truth, random);
    const PoseEstimate predicted = tracker.newest();
    const MatchVerdict verdict = tracker.correct(stamp, scans.match(points, predicted));
    scans.learn(verdict, tracker.newest().pose);
    if (verdict == MatchVerdict::kAccepted) ++accepted;
    worst = std::max(worst, distance(tracker.newest().pose, truth));
  }
  const double raw = std::abs(wrapped(odometry.heading - truth.heading));
  EXPECT_GT(raw, 0.3) << "odometry is far off by now";
  EXPECT_GT(accepted, 550);
  EXPECT_LT(worst, 0.08);
  EXPECT_LT(std::abs(wrapped(tracker.newest().pose.heading - truth.heading)), 0.03);
}

}  // namespace
}  // namespace pilothouse
