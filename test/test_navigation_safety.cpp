// Where no way is known any more the robot stands; what a person asked for stays so.
#include <gtest/gtest.h>

#include <cmath>

#include "test/task_harness.hpp"

namespace pilothouse {
namespace {

Wish routeOf(std::vector<Eigen::Vector2d> places) {
  Wish wish;
  wish.behaviour = "route";
  for (const auto& place : places) wish.stops.push_back({{place, 1.0}, 0.0});
  return wish;
}

TEST(NoWay, ASkipToAPointInAWallStopsTheRobot) {
  TaskHarness robot(hall().map);
  ASSERT_TRUE(robot.tasker.submit(routeOf({{5.0, 1.5}, {3.05, 0.5}})));
  robot.runUntil([&] { return robot.pose.x > 2.0; });
  EXPECT_EQ(robot.tasker.skip(), "");
  robot.step();
  EXPECT_EQ(robot.output.task.phase, TaskPhase::kFailed) << robot.output.task.text;
  EXPECT_TRUE(robot.order.poses.empty()) << "it drives on though nothing is to be done";
}

TEST(NoWay, ASkipToAPointThatIsBlockedStopsTheRobot) {
  TaskHarness robot(hall().map);
  ASSERT_TRUE(robot.tasker.submit(routeOf({{5.0, 1.5}, {2.5, 2.4}})));
  robot.runUntil([&] { return robot.pose.x > 2.0; });
  robot.planner.mark({{{2.5, 2.4}, 0.2}});
  EXPECT_EQ(robot.tasker.skip(), "");
  robot.step();
  EXPECT_EQ(robot.phase(), NavigationPhase::kWaiting) << robot.output.task.text;
  EXPECT_TRUE(robot.order.poses.empty());
}

TEST(Jump, APoseSetBehindADropOffLeavesTheOldWayAtOnce) {
  MapRoom room = hall();
  for (int x = 1; x < 36; ++x) {
    for (int y = 30; y < 34; ++y) room.map.cells[room.map.index(x, y)] = MapCell::kDropOff;
  }
  TaskHarness robot(room.map);
  robot.pose.y = 0.9;
  robot.goTo(5.0, 1.3);
  robot.runUntil([&] { return robot.pose.x > 1.6; });
  robot.pose = {1.6, 2.4, 0.0};
  robot.step();
  ASSERT_FALSE(robot.order.poses.empty());
  EXPECT_TRUE(robot.planner.free(robot.order.poses));
  EXPECT_NEAR((robot.order.poses.front().position() - robot.pose.position()).norm(), 0.0, 0.06);
  ASSERT_TRUE(robot.runToEnd());
  EXPECT_EQ(robot.output.task.phase, TaskPhase::kDone) << robot.output.task.text;
}

TEST(Manoeuvre, ADropOffOnItsWayEndsIt) {
  TaskHarness robot(hall().map);
  robot.goTo(5.0, 1.5);
  robot.runUntil([&] { return robot.pose.x > 2.4; });
  robot.held = true;
  ASSERT_TRUE(robot.runUntil([&] { return robot.phase() == NavigationPhase::kBacking; }));
  const int orders = robot.orders;
  robot.planner.mark({{robot.order.poses.back().position(), 0.15, MapCell::kDropOff}});
  robot.step();
  EXPECT_GT(robot.orders, orders);
  EXPECT_TRUE(robot.order.poses.empty() || robot.planner.free(robot.order.poses));
}

TEST(ByHand, WhatIsCancelledMeanwhileDoesNotComeBack) {
  TaskHarness robot(hall().map);
  const std::uint32_t goal = robot.goTo(5.0, 1.5);
  robot.runUntil([&] { return robot.pose.x > 1.5; });
  robot.takeOver();
  EXPECT_EQ(robot.tasker.cancel(), "");
  robot.step();
  EXPECT_EQ(robot.output.task.behaviour, "hand");
  ASSERT_EQ(robot.ended.size(), 1U);
  EXPECT_EQ(robot.ended[0].id, goal);
  EXPECT_FALSE(robot.tasker.cancel().empty()) << "driving by hand ends by itself";
  robot.hand = false;
  robot.runUntil([&] { return false; }, 5.0);
  EXPECT_TRUE(robot.order.poses.empty());
}

TEST(ByHand, WhatIsPausedMeanwhileStaysSo) {
  TaskHarness robot(hall().map);
  robot.goTo(5.0, 1.5);
  robot.runUntil([&] { return robot.pose.x > 1.5; });
  robot.takeOver();
  EXPECT_EQ(robot.tasker.pause(), "");
  robot.hand = false;
  robot.runUntil([&] { return false; }, 5.0);
  EXPECT_EQ(robot.output.task.behaviour, "go_to");
  EXPECT_EQ(robot.output.task.phase, TaskPhase::kPaused);
  EXPECT_TRUE(robot.order.poses.empty());
  EXPECT_EQ(robot.tasker.resume(), "");
  ASSERT_TRUE(robot.runToEnd());
  EXPECT_EQ(robot.output.task.phase, TaskPhase::kDone);
}

TEST(Loop, WithoutTwoPlacesIsRefused) {
  TaskHarness robot(hall().map);
  Wish wish = routeOf({{2.0, 1.5}});
  wish.loop = true;
  EXPECT_EQ(robot.tasker.submit(wish).reason(),
            "loop: its points lie in one place, expected two that are 0.05 m apart");
  wish.stops.push_back({{{2.5, 1.5}, {}}, 0.0});
  EXPECT_TRUE(robot.tasker.submit(wish));
}

TEST(MapsForPlans, TooFineOnesAreRefusedAndTheOldOneStays) {
  TaskHarness robot(hall().map);
  MapCells fine = hall().map;
  fine.cell_size = 0.002;
  EXPECT_THROW(robot.planner.setMap(fine), std::invalid_argument);
  robot.goTo(5.0, 1.5);
  ASSERT_TRUE(robot.runToEnd());
  EXPECT_EQ(robot.output.task.phase, TaskPhase::kDone);
}

TEST(MapsForPlans, AGoalOutsideDoesNotGrowAMapThatLiesElsewhere) {
  TaskHarness robot(hall().map);
  robot.goTo(9.0, 1.5);
  robot.step();
  EXPECT_GT(robot.planner.map().size_x, 120);
  MapCells elsewhere = hall().map;
  elsewhere.origin_x += 300.0;
  robot.planner.setMap(elsewhere);
  EXPECT_EQ(robot.planner.map().size_x, 120);
}

}  // namespace
}  // namespace pilothouse
