// Of a thing that the map lacks the robot sees the side that is turned to it: its way must keep off
// the others too.
#include "core/planning/hidden_sides.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "test/task_harness.hpp"

namespace pilothouse {
namespace {

using Eigen::Vector2d;

/// A box that the map does not have.
const FloorBox kBox{{2.5, 1.0}, {3.0, 2.0}};

/// The side of the box at x = 2.5, as the camera tells it.
std::vector<MapMark> face(bool remembered = false) {
  std::vector<MapMark> marks;
  for (double y = 1.025; y < 2.0; y += 0.05) {
    marks.push_back({{2.525, y}, 0.025, MapCell::kOccupied, remembered});
  }
  return marks;
}
MapRoom room() {
  return MapRoom(120, 80);  // 6 x 4 m
}
Planner roundPlanner(const MapCells& map) {
  Planner planner({}, Footprint({{0.2, 0.2}, {-0.2, 0.2}, {-0.2, -0.2}, {0.2, -0.2}}),
                  BaseKind::kDifferential);
  planner.setMap(map);
  return planner;
}
bool isBlocked(const Planner& planner, const Vector2d& place) {
  const MapCells& map = planner.map();
  return map.at(map.column(place.x()), map.row(place.y())) == MapCell::kOccupied;
}

/// How near the middle of the robot comes to the true box on a way past it [m].
double nearestTo(const FloorBox& box, Planner& planner) {
  const Plan plan = planner.plan({{1.4, 1.5, 0.0}, {4.0, 1.5}, std::nullopt});
  EXPECT_TRUE(plan);
  std::vector<Vector2d> points;
  for (const Pose2& pose : plan.poses) points.push_back(pose.position());
  const Route route(points, planner.parameters().corners);
  double least = HUGE_VAL;
  for (double way = 0.0; way < route.length(); way += 0.02) {
    const Vector2d place = route.at(way).position;
    least = std::min(least, (place - place.cwiseMax(box.low).cwiseMin(box.high)).norm());
  }
  return least;
}

TEST(HiddenSides, AWayRoundTheSeenSideOfABoxKeepsOffTheOthers) {
  Planner planner = roundPlanner(room().map);
  planner.markSeen(face(), {1.4, 1.5, 0.0});
  EXPECT_GT(nearestTo(kBox, planner), 0.2);
  planner.ignoreHidden(true);
  EXPECT_LT(nearestTo(kBox, planner), 0.2) << "otherwise this test shows nothing";
}

TEST(HiddenSides, NothingIsHiddenBehindWhatTheMapHas) {
  MapRoom known = room();
  known.addBox(50, 20, 52, 40);
  Planner planner = roundPlanner(known.map);
  planner.markSeen(face(), {1.4, 1.5, 0.0});
  EXPECT_FALSE(planner.hides());
  EXPECT_FALSE(isBlocked(planner, {2.75, 1.5}));
}

TEST(HiddenSides, AnUnknownThingBeforeAWallHidesNothingBehindTheWall) {
  MapRoom walled = room();
  walled.fill(56, 1, 58, 79);  // at x = 2.8
  Planner planner = roundPlanner(walled.map);
  planner.markSeen(face(), {1.4, 1.5, 0.0});
  EXPECT_TRUE(isBlocked(planner, {2.65, 1.5}));
  EXPECT_FALSE(isBlocked(planner, {2.95, 1.5}));
}

TEST(HiddenSides, StaysWhenTheFaceIsOnlyRememberedAndGoesWithIt) {
  Planner planner = roundPlanner(room().map);
  planner.markSeen(face(), {1.4, 1.5, 0.0});
  planner.markSeen(face(true), {2.1, 1.5, 1.0});
  EXPECT_TRUE(isBlocked(planner, {2.75, 1.5}));
  planner.markSeen({}, {2.1, 1.5, 1.0});
  EXPECT_FALSE(isBlocked(planner, {2.75, 1.5})) << "somebody who went on hides nothing";
}

TEST(HiddenSides, WhatIsOnlyRememberedHidesNothingNew) {
  Planner planner = roundPlanner(room().map);
  planner.markSeen(face(true), {1.4, 1.5, 0.0});
  EXPECT_FALSE(planner.hides());
}

TEST(HiddenSides, FloorThatIsSeenIsHiddenNoMore) {
  Planner planner = roundPlanner(room().map);
  planner.markSeen(face(), {1.4, 1.5, 0.0});
  // From the far side, looking back at it.
  planner.markSeen(face(true), {4.2, 1.5, 3.14159});
  EXPECT_FALSE(isBlocked(planner, {2.75, 1.5}));
  EXPECT_TRUE(isBlocked(planner, {2.525, 1.525})) << "the face itself stands";
}

TEST(HiddenSides, FloorBehindAnotherThingIsNotSeen) {
  Planner planner = roundPlanner(room().map);
  planner.markSeen(face(), {1.4, 1.5, 0.0});
  std::vector<MapMark> both = face(true);
  for (double y = 0.525; y < 2.5; y += 0.05) both.push_back({{3.325, y}, 0.025});
  planner.markSeen(both, {4.2, 1.5, 3.14159});
  EXPECT_TRUE(isBlocked(planner, {2.75, 1.5}));
}

TEST(HiddenSides, WhereTheRobotStandsNothingIsHidden) {
  Planner planner = roundPlanner(room().map);
  planner.markSeen(face(), {1.4, 1.5, 0.0});
  planner.markSeen(face(true), {2.75, 1.5, 0.0});
  EXPECT_FALSE(isBlocked(planner, {2.75, 1.5}));
}

TEST(HiddenSides, PlacesThatAreNoneAreLeftOut) {
  Planner planner = roundPlanner(room().map);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  planner.markSeen({{{nan, 1.0}, 0.02}, {{1e300, 1.0}, 0.02}, {{2.5, 1.5}, nan}}, {1.4, 1.5, 0.0});
  planner.markSeen(face(), {nan, 1.5, 0.0});
  EXPECT_FALSE(planner.hides());
}

// A gap that is free but for what may stand behind something: when it cannot be looked at from
// elsewhere the robot goes through.
TEST(HiddenSides, KeepsNobodyFromAGoalToWhichNoOtherWayLeads) {
  MapRoom narrow(120, 40);
  narrow.addBox(55, 1, 66, 14);
  narrow.addBox(55, 28, 66, 39);  // a gap of 0.7 m
  TaskHarness robot(narrow.map);
  robot.pose = {1.0, 1.0, 0.0};
  std::vector<MapMark> post;
  for (double y = 0.5; y < 0.76; y += 0.05) post.push_back({{2.45, y}, 0.025});
  const Pose2 seen_from{1.6, 0.2, 0.5};
  robot.planner.markSeen(post, seen_from);
  ASSERT_FALSE(robot.planner.plan({robot.pose, {5.0, 1.0}, std::nullopt}));
  robot.goTo(5.0, 1.0);
  const bool ended = robot.runUntil([&] {
    robot.planner.markSeen(post, seen_from);
    return robot.output.task.phase >= TaskPhase::kDone;
  });
  ASSERT_TRUE(ended);
  EXPECT_EQ(robot.output.task.phase, TaskPhase::kDone) << robot.output.task.text;
}

}  // namespace
}  // namespace pilothouse
