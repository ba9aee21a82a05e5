// Goals and routes before they are sent: what is asked of the planner, shown and edited.

#include <gtest/gtest.h>

#include <limits>
#include <memory>

#include "gui/model/goal_aim.hpp"
#include "gui/model/route_preview.hpp"

using namespace pilothouse;
using namespace pilothouse::gui;

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::shared_ptr<const Preview> found(std::uint32_t id, double length) {
  auto preview = std::make_shared<Preview>();
  preview->id = id;
  preview->answered = preview->found = true;
  preview->path.points = {{0, 0}, {length, 0}};
  preview->path.length = length;
  preview->time = 2.0 * length;
  return preview;
}

std::shared_ptr<const Preview> noWay(std::uint32_t id, Eigen::Vector2d nearest) {
  auto preview = std::make_shared<Preview>();
  preview->id = id;
  preview->answered = true;
  preview->why = "something stands there";
  preview->nearest = nearest;
  return preview;
}

RouteDraft square() {
  RouteDraft draft;
  const double corners[][2] = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  for (const auto& p : corners) draft.points.push_back({{{p[0], p[1]}, std::nullopt}, 0.0});
  return draft;
}

TEST(GoalAim, asksAnewAfterEachChangeAndHeedsOnlyTheAnswerToTheNewest) {
  GoalAim aim;
  std::uint32_t first = 0, second = 0;
  EXPECT_FALSE(aim.due(0.0, first)) << "nothing is aimed at";
  aim.place({1, 2});
  ASSERT_TRUE(aim.due(0.0, first));
  EXPECT_FALSE(aim.due(0.05, second)) << "asked already";
  aim.face({1, 3});
  EXPECT_FALSE(aim.due(0.1, second)) << "too soon after the last ask";
  const auto ask = aim.due(0.2, second);
  ASSERT_TRUE(ask);
  EXPECT_NEAR(*ask->heading, M_PI / 2, 1e-12);
  aim.answered(found(first, 5.0));
  EXPECT_EQ(aim.phase(0.2), AimPhase::kAsking) << "that was the old goal's way";
  EXPECT_FALSE(aim.send(0.2)) << "its way was not shown yet";
  aim.answered(found(second, 3.0));
  EXPECT_EQ(aim.phase(0.2), AimPhase::kFound);
  EXPECT_EQ(goalWords(aim, 0.2).headline, "3.0 m, about 6 s");
  const auto sent = aim.send(0.3);
  ASSERT_TRUE(sent);
  EXPECT_EQ(sent->place, Eigen::Vector2d(1, 2));
  EXPECT_EQ(aim.phase(0.3), AimPhase::kNone);
  EXPECT_FALSE(aim.send(0.4)) << "sent once";
}

TEST(GoalAim, withoutAWayTheReasonAndTheNearestPlace) {
  GoalAim aim;
  std::uint32_t id = 0;
  aim.place({4, 0});
  aim.setHeading(1.0);
  ASSERT_TRUE(aim.due(0.0, id));
  EXPECT_FALSE(aim.takeNearest());
  aim.answered(noWay(id, {3, 0}));
  EXPECT_EQ(aim.phase(0.1), AimPhase::kNoWay);
  EXPECT_EQ(goalWords(aim, 0.1).headline, "No way there: something stands there");
  EXPECT_FALSE(aim.send(0.1));
  ASSERT_TRUE(aim.takeNearest());
  EXPECT_EQ(aim.goal()->place, Eigen::Vector2d(3, 0));
  EXPECT_EQ(aim.goal()->heading, 1.0);
  EXPECT_EQ(aim.phase(0.2), AimPhase::kAsking);
}

TEST(GoalAim, whereThePlaceCanBeReachedButNotWithItsHeadingAnyHeadingIsTaken) {
  GoalAim aim;
  std::uint32_t id = 0;
  aim.place({4, 0});
  aim.setHeading(1.0);
  ASSERT_TRUE(aim.due(0.0, id));
  aim.answered(noWay(id, {4.01, 0}));
  ASSERT_TRUE(aim.takeNearest());
  EXPECT_FALSE(aim.goal()->heading);
}

TEST(GoalAim, aPlannerThatIsSilentOrAbsentHindersNoSending) {
  GoalAim aim;
  std::uint32_t id = 0;
  aim.place({1, 0});
  ASSERT_TRUE(aim.due(0.0, id));
  EXPECT_EQ(aim.phase(GoalAim::kPatience - 0.1), AimPhase::kAsking);
  EXPECT_EQ(aim.phase(GoalAim::kPatience + 0.1), AimPhase::kUnanswered);
  EXPECT_TRUE(aim.send(GoalAim::kPatience + 0.1));
  aim.place({1, 0});
  ASSERT_TRUE(aim.due(10.0, id));
  auto none = std::make_shared<Preview>();
  none->id = id;
  none->why = "no service /plan_path";
  aim.answered(none);
  EXPECT_EQ(aim.phase(10.0), AimPhase::kUnanswered);
  EXPECT_EQ(goalWords(aim, 10.0).headline, "No preview: no service /plan_path");
}

/// Answers to whatever is due until nothing is. @return the asks.
std::vector<LegAsk> answerAll(RoutePreview& ways, double& now) {
  std::vector<LegAsk> asks;
  for (int i = 0; i < 100; ++i, now += 0.2) {
    const auto ask = ways.due(now);
    if (!ask) {
      if (i > 2) break;
      continue;
    }
    asks.push_back(*ask);
    EXPECT_FALSE(ways.due(now + 0.2)) << "one at a time";
    EXPECT_TRUE(ways.answered(found(ask->id, 3.0)));
  }
  return asks;
}

TEST(RoutePreview, asksLegByLegOnceTheRouteRestsAndKeepsTheWaysThatStay) {
  RoutePreview ways;
  RouteDraft draft = square();
  draft.points[1].goal.heading = 0.5;
  draft.points[2].pause = 7.0;
  double now = 10.0;
  ways.follow(draft, now);
  EXPECT_FALSE(ways.due(now)) << "it changes";
  now += RoutePreview::kRest;
  auto asks = answerAll(ways, now);
  ASSERT_EQ(asks.size(), 4U);
  EXPECT_FALSE(asks[0].from) << "from where the robot is";
  ASSERT_TRUE(asks[1].from);
  EXPECT_EQ(asks[1].from->heading, 0.0) << "towards the next point";
  EXPECT_EQ(asks[2].from->heading, 0.5) << "as the point says";
  EXPECT_TRUE(ways.sum().complete);
  EXPECT_NEAR(ways.sum().length, 12.0, 1e-9);
  EXPECT_NEAR(ways.sum().time, 4 * 6.0 + 7.0, 1e-9);

  draft.loop = true;
  draft = withPlace(draft, 3, {0.5, 2.5});
  ways.follow(draft, now);
  EXPECT_FALSE(ways.sum().complete);
  EXPECT_TRUE(ways.legTo(1)) << "not touched";
  EXPECT_FALSE(ways.legTo(3));
  now += RoutePreview::kRest;
  asks = answerAll(ways, now);
  ASSERT_EQ(asks.size(), 2U) << "to the point that was moved, and from it back to the first";
  EXPECT_EQ(asks[0].to.place, Eigen::Vector2d(0.5, 2.5));
  EXPECT_EQ(asks[1].to.place, Eigen::Vector2d(0, 0));
  now += RoutePreview::kAgain;
  EXPECT_TRUE(ways.due(now)) << "the map may be another by now";
}

TEST(RoutePreview, asksAgainForALegWhoseAnswerCameTooLate) {
  RoutePreview ways;
  RouteDraft draft = square();
  double now = RoutePreview::kRest;
  ways.follow(draft, 0.0);
  const auto first = ways.due(now);
  ASSERT_TRUE(first && !first->from);
  draft = withPlace(draft, 3, {0.5, 2.5});
  ways.follow(draft, now);
  EXPECT_FALSE(ways.answered(found(first->id, 1.0))) << "that was the route before";
  now += RoutePreview::kRest;
  const auto again = ways.due(now);
  ASSERT_TRUE(again);
  EXPECT_FALSE(again->from);
}

TEST(RoutePreview, tellsTheFirstLegWithoutAWayAndHeedsNobodyElsesAnswers) {
  RoutePreview ways;
  double now = 0.0;
  ways.follow(square(), now);
  now += RoutePreview::kRest;
  for (int i = 0; i < 4; ++i, now += 0.2) {
    const auto ask = ways.due(now);
    ASSERT_TRUE(ask);
    EXPECT_FALSE(ways.answered(found(7, 1.0))) << "a goal's";
    EXPECT_TRUE(ways.answered(i < 2 ? found(ask->id, 1.0) : noWay(ask->id, {1, 1})));
  }
  EXPECT_FALSE(ways.sum().complete);
  EXPECT_EQ(ways.sum().blocked, 2U);
}

TEST(RoutePreview, boundsTheLegsAndWaitsForNoSilentPlanner) {
  RoutePreview ways;
  RouteDraft draft;
  for (int i = 0; i < 1000; ++i) draft.points.push_back({{{i * 0.1, 0.0}, std::nullopt}, 0.0});
  double now = 0.0;
  ways.follow(draft, now);
  now += RoutePreview::kRest;
  const auto first = ways.due(now);
  ASSERT_TRUE(first);
  EXPECT_FALSE(ways.due(now + RoutePreview::kPatience - 0.1));
  const auto second = ways.due(now + RoutePreview::kPatience + 0.1);
  ASSERT_TRUE(second) << "the next";
  EXPECT_FALSE(ways.answered(found(first->id, 1.0))) << "too late";
  EXPECT_TRUE(ways.answered(found(second->id, 1.0)));
  EXPECT_FALSE(ways.legTo(RoutePreview::kMostLegs));
  EXPECT_FALSE(ways.sum().complete);
  ways.follow({}, now);
  EXPECT_FALSE(ways.due(now + 100.0)) << "nothing to plan";
}

TEST(GoalAim, refusesWhatIsNotFinite) {
  GoalAim aim;
  aim.place({kNaN, 0});
  EXPECT_FALSE(aim.goal());
  aim.place({1, 1});
  aim.face({1, 1});
  EXPECT_FALSE(aim.goal()->heading) << "the place itself is no direction";
  aim.face({kNaN, 1});
  aim.turn(kNaN);
  EXPECT_FALSE(aim.goal()->heading);
  aim.turn(4.0);
  EXPECT_NEAR(*aim.goal()->heading, 4.0 - 2 * M_PI, 1e-12);
}

TEST(RouteDraft, findsPointsAndLegsUnderTheCursor) {
  RouteDraft draft = square();
  EXPECT_EQ(pointAt(draft, {2.05, 0.0}, 0.1), 1U);
  EXPECT_FALSE(pointAt(draft, {1.0, 0.0}, 0.1));
  EXPECT_EQ(legAt(draft, {1.0, 0.05}, 0.1), 1U);
  EXPECT_EQ(legAt(draft, {1.95, 1.0}, 0.1), 2U);
  EXPECT_FALSE(legAt(draft, {0.0, 1.0}, 0.1)) << "only a loop goes back";
  EXPECT_EQ(legAt(withLoop(draft, true), {0.0, 1.0}, 0.1), 4U);
  EXPECT_DOUBLE_EQ(draft.length(), 6.0);
  EXPECT_DOUBLE_EQ(withLoop(draft, true).length(), 8.0);
}

TEST(RouteDraft, stepsThatCannotBeLeaveItAsItWas) {
  const RouteDraft draft = square();
  EXPECT_EQ(withoutPoint(draft, 4), draft);
  EXPECT_EQ(withPlace(draft, 0, {kNaN, 0}), draft);
  EXPECT_EQ(withPoint(draft, 5, {}), draft);
  EXPECT_EQ(withOrder(draft, 0, -1), draft);
  EXPECT_EQ(withOrder(draft, 3, 1), draft);
  EXPECT_EQ(withHeading(draft, 0, kNaN), draft);
  EXPECT_EQ(withPause(draft, 0, 1e9).points[0].pause, RouteDraft::kMostPause);
  EXPECT_EQ(withOrder(draft, 0, 1).points[1].goal.place, draft.points[0].goal.place);
  RouteDraft full;
  full.points.resize(RouteDraft::kMostPoints);
  EXPECT_EQ(withPoint(full, 0, {}).points.size(), RouteDraft::kMostPoints);
  EXPECT_EQ(faultOf(RouteDraft()), "the route has no points");
  EXPECT_EQ(faultOf(draft), "");
}

}  // namespace
