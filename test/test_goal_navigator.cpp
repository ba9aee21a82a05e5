// Goals and tasks with a robot that follows its orders exactly, or does not get on.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "test/task_harness.hpp"

namespace pilothouse {
namespace {

TEST(GoTo, ReachesItsGoalWithTheHeading) {
  TaskHarness robot(hall().map);
  robot.goTo(5.0, 2.5, 1.0);
  ASSERT_TRUE(robot.runToEnd());
  EXPECT_EQ(robot.output.task.phase, TaskPhase::kDone);
  EXPECT_EQ(robot.phase(), NavigationPhase::kReached);
  EXPECT_NEAR(robot.pose.x, 5.0, 0.05);
  EXPECT_NEAR(robot.pose.y, 2.5, 0.05);
  EXPECT_NEAR(robot.pose.heading, 1.0, 0.05);
  EXPECT_EQ(robot.orders, 1) << "one way is enough where nothing changes";
}

TEST(GoTo, TellsDistanceAndTimeLeftAsTheyFall) {
  TaskHarness robot(hall().map);
  robot.goTo(5.0, 1.5);
  robot.step();
  ASSERT_TRUE(robot.output.behaviour.navigation.distance_left);
  EXPECT_NEAR(*robot.output.behaviour.navigation.distance_left, 4.0, 0.1);
  robot.runUntil([&] { return robot.pose.x > 3.0; });
  EXPECT_NEAR(*robot.output.behaviour.navigation.distance_left, 5.0 - robot.pose.x, 0.1);
  EXPECT_NEAR(*robot.output.behaviour.navigation.time_left, (5.0 - robot.pose.x) / 0.45, 1.5);
}

TEST(GoTo, SaysAtOnceThatThereIsNoWay) {
  MapRoom room = hall();
  room.fill(60, 1, 62, 59);
  TaskHarness robot(room.map);
  robot.goTo(5.0, 1.5);
  robot.step();
  EXPECT_EQ(robot.output.task.phase, TaskPhase::kFailed);
  EXPECT_EQ(robot.output.task.text, textOf(NoWay::kWalledOff));
  ASSERT_TRUE(robot.output.behaviour.navigation.nearest);
  EXPECT_EQ(robot.orders, 1) << "only the one to stop";
  EXPECT_TRUE(robot.order.poses.empty());
}

TEST(GoTo, PlansAnewInTheStepInWhichTheWayIsBlocked) {
  TaskHarness robot(hall().map);
  robot.goTo(5.0, 1.5);
  robot.runUntil([&] { return robot.pose.x > 2.0; });
  const int before = robot.orders;
  robot.planner.mark({{{3.05, 1.2}, 0.1}});
  robot.step();
  EXPECT_EQ(robot.orders, before + 1);
  EXPECT_TRUE(robot.planner.free(robot.order.poses));
  ASSERT_TRUE(robot.runToEnd());
  EXPECT_EQ(robot.output.task.phase, TaskPhase::kDone);
}

TEST(GoTo, WaitsForADoorToBecomeFree) {
  TaskHarness robot(hall().map);
  robot.goTo(5.0, 1.5);
  robot.planner.mark({{{3.05, 1.5}, 0.3}});
  ASSERT_TRUE(robot.runUntil([&] { return robot.phase() == NavigationPhase::kWaiting; }));
  EXPECT_GT(robot.pose.x, 1.1) << "from nearer it may look free";
  EXPECT_LT(robot.pose.x, 2.45) << "not into it";
  EXPECT_EQ(robot.output.task.phase, TaskPhase::kRunning);
  EXPECT_NE(robot.output.task.text.find("blocked"), std::string::npos) << robot.output.task.text;
  robot.planner.mark({});
  ASSERT_TRUE(robot.runToEnd());
  EXPECT_EQ(robot.output.task.phase, TaskPhase::kDone);
}

TEST(GoTo, WhatIsSeenFarOffKeepsNobodyFromAGoal) {
  TaskHarness robot(hall().map);
  const auto seen = [&robot] {
    const bool far = (robot.pose.position() - Eigen::Vector2d(5.0, 1.5)).norm() > 1.7;
    robot.planner.mark(far ? std::vector<Planner::Mark>{{{5.0, 1.6}, 0.1}}
                           : std::vector<Planner::Mark>{});
    return robot.output.task.phase >= TaskPhase::kDone;
  };
  seen();
  robot.goTo(5.0, 1.5);
  ASSERT_TRUE(robot.runUntil(seen));
  EXPECT_EQ(robot.output.task.phase, TaskPhase::kDone) << robot.output.task.text;
  EXPECT_FALSE(robot.was(NavigationPhase::kWaiting));
  EXPECT_LE(robot.orders, 4) << "the way is left alone while it is good";
}

TEST(GoTo, WhatStandsAtTheGoalIsSaidFromNearBy) {
  NavigationParameters parameters;
  parameters.tries = 1;
  TaskHarness robot(hall().map, parameters);
  robot.planner.mark({{{5.0, 1.6}, 0.1}});
  robot.goTo(5.0, 1.5);
  ASSERT_TRUE(robot.runToEnd());
  EXPECT_EQ(robot.output.task.phase, TaskPhase::kFailed);
  EXPECT_NE(robot.output.task.text.find(textOf(NoWay::kGoalOccupied)), std::string::npos)
      << robot.output.task.text;
  const double off = (robot.pose.position() - Eigen::Vector2d(5.0, 1.5)).norm();
  EXPECT_LT(off, parameters.trust_distance + 0.2) << "it looked from where it sees well";
  EXPECT_GT(off, 0.5);
}

TEST(GoTo, HeldWithinItsToleranceOfTheGoalItOnlyTurns) {
  TaskHarness robot(hall().map);
  robot.pose.x = 1.01;
  robot.goTo(5.0, 1.5, 2.0);
  ASSERT_TRUE(robot.runUntil([&] { return robot.pose.x > 4.955; }));
  robot.held = true;
  ASSERT_TRUE(robot.runToEnd(20.0));
  EXPECT_EQ(robot.output.task.phase, TaskPhase::kDone) << robot.output.task.text;
  EXPECT_NEAR(robot.pose.x, 4.96, 1e-6) << "nearer it was not let";
  EXPECT_NEAR(robot.pose.heading, 2.0, 0.05);
  EXPECT_FALSE(robot.was(NavigationPhase::kLooking));
  EXPECT_FALSE(robot.was(NavigationPhase::kBacking));
}

// What holds it is looked at once: by the executor, which goes back for it.
TEST(GoTo, WhileTheExecutorLooksItWaitsAndDoesNotLookRoundAfterIt) {
  TaskHarness robot(hall().map);
  robot.goTo(5.0, 1.5);
  robot.runUntil([&] { return robot.pose.x > 2.2; });
  robot.held = true;
  robot.runUntil([] { return false; }, 0.5);
  const int orders = robot.orders;
  robot.looks = true;
  robot.runUntil([] { return false; }, 8.0);
  EXPECT_EQ(robot.orders, orders) << "it is let look, longer than the patience is";
  robot.looks = false;
  ASSERT_TRUE(robot.runUntil([&] { return robot.was(NavigationPhase::kBacking); }, 10.0));
  EXPECT_FALSE(robot.was(NavigationPhase::kLooking));
  ASSERT_TRUE(robot.runToEnd());
  EXPECT_TRUE(robot.was(NavigationPhase::kLooking)) << "but later it looks all round too";
}

TEST(GoTo, AnExecutorThatLooksForeverIsNotWaitedFor) {
  TaskHarness robot(hall().map);
  robot.goTo(5.0, 1.5);
  robot.runUntil([&] { return robot.pose.x > 2.2; });
  robot.looks = true;
  ASSERT_TRUE(robot.runToEnd());
  EXPECT_EQ(robot.output.task.phase, TaskPhase::kFailed);
}

TEST(GoTo, StuckItLooksRoundBacksOffAndGivesUpWithTheReason) {
  NavigationParameters parameters;
  parameters.tries = 2;
  TaskHarness robot(hall().map, parameters);
  robot.goTo(5.0, 1.5);
  robot.runUntil([&] { return robot.pose.x > 2.2; });
  robot.held = true;
  const double since = robot.now;
  ASSERT_TRUE(robot.runToEnd());
  EXPECT_EQ(robot.output.task.phase, TaskPhase::kFailed);
  EXPECT_NE(robot.output.task.text.find("gave up after 2 tries: held: seen by camera"),
            std::string::npos)
      << robot.output.task.text;
  EXPECT_TRUE(robot.was(NavigationPhase::kWaiting));
  EXPECT_TRUE(robot.was(NavigationPhase::kLooking));
  EXPECT_TRUE(robot.was(NavigationPhase::kBacking));
  EXPECT_GE(robot.turns, 6) << "to both sides and back, twice";
  EXPECT_TRUE(robot.order.poses.empty()) << "the robot is told to stop";
  EXPECT_GT(robot.now - since, 2.0 * parameters.patience);
  EXPECT_LT(robot.now - since, 120.0);
}

TEST(GoTo, GoesToLookAtWhatItIsTooNearToToSee) {
  // Somebody walked on, but what was seen of them stays in mind while the robot is nearer to it
  // than its camera sees, or looks elsewhere.
  TaskHarness robot(hall().map);
  const Eigen::Vector2d gone(4.9, 1.5);
  bool remembered = true;
  const auto step = [&] {
    const Eigen::Vector2d seen = robot.pose.toBase(gone);
    const bool in_view = seen.x() > 0.8 && std::abs(seen.y()) < 0.5 * seen.x();
    const bool came = robot.pose.x > 4.3;
    if (came && in_view) remembered = false;
    robot.planner.mark(came && remembered ? std::vector<Planner::Mark>{{gone, 0.1}}
                                          : std::vector<Planner::Mark>{});
    return robot.output.task.phase >= TaskPhase::kDone;
  };
  robot.goTo(5.0, 1.5);
  ASSERT_TRUE(robot.runUntil(step));
  EXPECT_EQ(robot.output.task.phase, TaskPhase::kDone) << robot.output.task.text;
  EXPECT_FALSE(remembered);
  EXPECT_TRUE(robot.was(NavigationPhase::kBacking));
}

TEST(GoTo, TakesAnotherWayThanTheOneItIsHeldOn) {
  MapRoom room(120, 60);
  room.fill(60, 1, 62, 10);
  room.fill(60, 24, 62, 36);  // two doors, the nearer one at y = 0.85
  room.fill(60, 50, 62, 59);
  TaskHarness robot(room.map);
  robot.pose.y = 0.85;
  robot.goTo(5.0, 0.85);
  bool near_door = false;
  ASSERT_TRUE(robot.runUntil([&] {
    // Nothing that the planner knows is in the way, but the robot is not let through.
    const bool on = !robot.order.poses.empty() && robot.order.poses.back().x > robot.pose.x;
    robot.held = on && robot.pose.x > 2.5 && robot.pose.x < 3.0 && robot.pose.y < 1.4;
    near_door = near_door || robot.held;
    return robot.output.task.phase >= TaskPhase::kDone;
  }));
  EXPECT_TRUE(near_door);
  EXPECT_EQ(robot.output.task.phase, TaskPhase::kDone) << robot.output.task.text;
  EXPECT_NEAR(robot.pose.x, 5.0, 0.05);
}

TEST(GoTo, GetsOnWhenWhatHeldItHasLeft) {
  TaskHarness robot(hall().map);
  robot.goTo(5.0, 1.5);
  robot.runUntil([&] { return robot.pose.x > 2.2; });
  robot.held = true;
  ASSERT_TRUE(robot.runUntil([&] { return robot.phase() == NavigationPhase::kBacking; }));
  robot.held = false;
  ASSERT_TRUE(robot.runToEnd());
  EXPECT_EQ(robot.output.task.phase, TaskPhase::kDone);
}

TEST(GoTo, AStoppedGateIsNoReasonToGiveUp) {
  TaskHarness robot(hall().map);
  robot.goTo(5.0, 1.5);
  robot.runUntil([&] { return robot.pose.x > 2.2; });
  robot.halted = true;
  robot.runUntil([&] { return false; }, 300.0);
  EXPECT_EQ(robot.output.task.phase, TaskPhase::kRunning);
  EXPECT_EQ(robot.phase(), NavigationPhase::kWaiting);
  EXPECT_FALSE(robot.was(NavigationPhase::kLooking));
  robot.halted = false;
  ASSERT_TRUE(robot.runToEnd());
  EXPECT_EQ(robot.output.task.phase, TaskPhase::kDone);
}

TEST(GoTo, TimeThatGoesBackHarmsNothing) {
  TaskHarness robot(hall().map);
  robot.goTo(5.0, 1.5);
  robot.runUntil([&] { return robot.pose.x > 2.2; });
  robot.now -= 90.0;
  ASSERT_TRUE(robot.runToEnd());
  EXPECT_EQ(robot.output.task.phase, TaskPhase::kDone);
  EXPECT_FALSE(robot.was(NavigationPhase::kLooking));
}

TEST(GoTo, GivesUpWithoutAPoseAndWithoutAMap) {
  TaskHarness lost(hall().map);
  lost.goTo(5.0, 1.5);
  lost.runUntil([&] { return lost.pose.x > 2.0; });
  lost.localised = false;
  ASSERT_TRUE(lost.runToEnd(20.0));
  EXPECT_EQ(lost.output.task.phase, TaskPhase::kFailed);
  EXPECT_TRUE(lost.order.poses.empty());

  Planner planner({}, Footprint({{0.2, 0.2}, {-0.2, 0.2}, {0.0, -0.2}}), BaseKind::kDifferential);
  GoalNavigator navigator({}, planner);
  navigator.start({{1.0, 1.0}, std::nullopt});
  NavigationInput input;
  input.pose = Pose2{};
  NavigationOutput output;
  for (input.now = 5.0; input.now < 10.0; input.now += 0.1) output = navigator.step(input);
  EXPECT_EQ(output.status.phase, NavigationPhase::kFailed);
  EXPECT_EQ(output.status.text, textOf(NoWay::kNoMap));
}

// On a slow computer the first of the floor that it sees is learnt before the place where it
// stands.
TEST(GoalNavigator, WaitsForAMapThatHasJustBegunToReachTheRobot) {
  for (const bool grows : {true, false}) {
    Planner planner({}, Footprint({{0.2, 0.2}, {-0.2, 0.2}, {0.0, -0.2}}), BaseKind::kDifferential);
    const MapCells all = hall().map;
    MapCells begun = all;
    begun.origin_x += 100.0;
    planner.setMap(begun);
    GoalNavigator navigator({}, planner);
    navigator.start({{2.0, 1.5}, std::nullopt});
    NavigationInput input;
    input.pose = Pose2{1.0, 1.5, 0.0};
    NavigationOutput output;
    bool driven = false;
    for (input.now = 5.0; input.now < 10.0; input.now += 0.1) {
      if (grows && input.now > 7.0) planner.setMap(all);
      output = navigator.step(input);
      driven = driven || (output.order && output.order->poses.size() > 1);
      if (input.now > 7.0) continue;
      EXPECT_EQ(output.status.phase, NavigationPhase::kPlanning);
      EXPECT_EQ(output.status.text, textOf(NoWay::kStartOutside)) << "said at once";
    }
    EXPECT_EQ(driven, grows);
    EXPECT_EQ(output.status.phase == NavigationPhase::kFailed, !grows);
    EXPECT_EQ(output.status.text == textOf(NoWay::kStartOutside), !grows) << output.status.text;
  }
}

TEST(Tasker, RefusesWishesThatCannotBeAndStaysAsItWas) {
  TaskHarness robot(hall().map);
  const std::uint32_t id = robot.goTo(5.0, 1.5);
  robot.step();
  Wish wish;
  wish.behaviour = "dance";
  EXPECT_NE(robot.tasker.submit(wish).reason().find("hand, go_to, route"), std::string::npos);
  wish.behaviour = "go_to";
  EXPECT_FALSE(robot.tasker.submit(wish)) << "no goal";
  wish.stops = {{{{std::nan(""), 0.0}, {}}, 0.0}};
  EXPECT_FALSE(robot.tasker.submit(wish));
  wish.stops = {{{{0.0, 0.0}, std::numeric_limits<double>::infinity()}, 0.0}};
  EXPECT_FALSE(robot.tasker.submit(wish));
  wish.behaviour = "route";
  wish.stops = {{{{0.0, 0.0}, {}}, -1.0}};
  EXPECT_NE(robot.tasker.submit(wish).reason().find("point 0: pause is -1"), std::string::npos);
  wish.stops.assign(10000, RouteStop{});
  EXPECT_NE(robot.tasker.submit(wish).reason().find("10000 points, expected at most 1000"),
            std::string::npos);
  robot.step();
  EXPECT_EQ(robot.output.task.id, id);
  EXPECT_EQ(robot.output.task.phase, TaskPhase::kRunning);
}

TEST(Tasker, ANewGoalReplacesTheOld) {
  TaskHarness robot(hall().map);
  const std::uint32_t first = robot.goTo(5.0, 1.5);
  robot.step();
  const std::uint32_t second = robot.goTo(2.0, 2.5);
  robot.step();
  ASSERT_EQ(robot.ended.size(), 1U);
  EXPECT_EQ(robot.ended[0].id, first);
  EXPECT_EQ(robot.ended[0].phase, TaskPhase::kCancelled);
  ASSERT_TRUE(robot.runToEnd());
  EXPECT_EQ(robot.output.task.id, second);
  EXPECT_NEAR(robot.pose.x, 2.0, 0.05);
}

TEST(Tasker, DrivingByHandSetsTheGoalAsideUntilLetGo) {
  TaskHarness robot(hall().map);
  const std::uint32_t goal = robot.goTo(5.0, 1.5);
  robot.runUntil([&] { return robot.pose.x > 2.0; });
  robot.takeOver();
  EXPECT_EQ(robot.output.task.behaviour, "hand");
  EXPECT_EQ(robot.output.waiting, std::vector<std::string>{"go_to"});
  EXPECT_TRUE(robot.order.poses.empty()) << "the executor must not drive against the hand";
  robot.pose = {1.2, 2.2, 2.0};
  robot.runUntil([&] { return false; }, 5.0);
  EXPECT_EQ(robot.output.task.behaviour, "hand");
  robot.hand = false;
  ASSERT_TRUE(robot.runUntil([&] { return robot.output.task.behaviour == "go_to"; }, 3.0));
  ASSERT_TRUE(robot.runToEnd());
  EXPECT_EQ(robot.output.task.id, goal);
  EXPECT_EQ(robot.output.task.phase, TaskPhase::kDone);
  EXPECT_NEAR(robot.pose.x, 5.0, 0.05);
}

TEST(Tasker, PausesResumesAndCancels) {
  TaskHarness robot(hall().map);
  EXPECT_FALSE(robot.tasker.pause().empty()) << "nothing runs";
  robot.goTo(5.0, 1.5);
  robot.runUntil([&] { return robot.pose.x > 2.0; });
  EXPECT_EQ(robot.tasker.pause(), "");
  EXPECT_FALSE(robot.tasker.pause().empty());
  robot.step();
  const Pose2 stood = robot.pose;
  EXPECT_TRUE(robot.order.poses.empty());
  robot.runUntil([&] { return false; }, 60.0);
  EXPECT_EQ(robot.output.task.phase, TaskPhase::kPaused);
  EXPECT_EQ(robot.pose.position(), stood.position());
  EXPECT_EQ(robot.tasker.resume(), "");
  robot.runUntil([&] { return robot.pose.x > 2.5; });
  EXPECT_EQ(robot.output.task.phase, TaskPhase::kRunning);
  EXPECT_FALSE(robot.tasker.cancel(77).empty());
  EXPECT_EQ(robot.tasker.cancel(), "");
  robot.step();
  EXPECT_EQ(robot.output.task.phase, TaskPhase::kCancelled);
  EXPECT_TRUE(robot.order.poses.empty());
  EXPECT_FALSE(robot.tasker.resume().empty());
}

TEST(Route, PassesItsPointsStandsAndEnds) {
  TaskHarness robot(hall().map);
  Wish wish;
  wish.behaviour = "route";
  wish.stops = {{{{2.0, 0.8}, {}}, 0.0}, {{{5.0, 1.5}, 1.5}, 4.0}, {{{4.0, 2.4}, {}}, 0.0}};
  ASSERT_TRUE(robot.tasker.submit(wish));
  ASSERT_TRUE(robot.runUntil([&] { return robot.output.behaviour.point == 1; }));
  EXPECT_NEAR((robot.pose.position() - wish.stops[0].goal.place).norm(), 0.3, 0.1)
      << "not stood at";
  ASSERT_TRUE(robot.runUntil([&] { return robot.phase() == NavigationPhase::kPausing; }));
  EXPECT_NEAR(robot.pose.heading, 1.5, 0.05);
  const double since = robot.now;
  ASSERT_TRUE(robot.runUntil([&] { return robot.output.behaviour.point == 2; }));
  EXPECT_NEAR(robot.now - since, 4.0, 0.35);
  ASSERT_TRUE(robot.runToEnd());
  EXPECT_EQ(robot.output.task.phase, TaskPhase::kDone);
  EXPECT_NEAR(robot.pose.y, 2.4, 0.05);
}

TEST(Route, LoopsSkipsAndFailsAtAPointWithoutAWay) {
  TaskHarness robot(hall().map);
  Wish wish;
  wish.behaviour = "route";
  wish.loop = true;
  wish.stops = {{{{2.0, 0.8}, {}}, 0.0}, {{{5.0, 1.5}, {}}, 0.0}, {{{2.0, 2.2}, {}}, 0.0}};
  ASSERT_TRUE(robot.tasker.submit(wish));
  ASSERT_TRUE(robot.runUntil([&] { return robot.output.behaviour.point == 2; }));
  ASSERT_TRUE(robot.runUntil([&] { return robot.output.behaviour.point == 0; })) << "round again";
  EXPECT_EQ(robot.tasker.skip(), "");
  robot.step();
  EXPECT_EQ(robot.output.behaviour.point, 1U);
  wish.loop = false;
  wish.stops = {{{{2.0, 0.8}, {}}, 0.0}, {{{3.05, 0.5}, {}}, 0.0}};
  ASSERT_TRUE(robot.tasker.submit(wish));
  ASSERT_TRUE(robot.runToEnd());
  EXPECT_EQ(robot.output.task.phase, TaskPhase::kFailed);
  EXPECT_EQ(robot.output.task.text, "point 2 of 2: something stands at the goal");
  EXPECT_FALSE(robot.tasker.skip().empty());
}

TEST(Behaviours, HaveNamesAndPrioritiesOfTheirOwn) {
  for (const auto& kind : behaviourKinds()) {
    for (const auto& other : behaviourKinds()) {
      EXPECT_EQ(&kind == &other, std::string(kind.name) == other.name);
    }
    EXPECT_GT(kind.priority, 0);
  }
  EXPECT_GE(behaviourKinds().size(), 3U);
}

}  // namespace
}  // namespace pilothouse
