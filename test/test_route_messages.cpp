// Routes that only happen to end where they begin, and which route the executor speaks of.
#include <gtest/gtest.h>

#include "doors/motion_views.hpp"
#include "nodelets/navigation_messages.hpp"

namespace pilothouse {
namespace {

nav_msgs::Path pathOf(const std::vector<Pose2>& poses) {
  ros::Time::init();
  return toPath("map", poses);
}

TEST(RouteMessages, ARouteThatHappensToEndWhereItBeginsIsKeptFromGoingRound) {
  for (const double gap : {0.0, 0.0004, -0.0009}) {
    nav_msgs::Path path = pathOf({{1, 2, 0}, {3, 2, 0}, {3, 4, 0}, {1 + gap, 2, 0.5}});
    ASSERT_TRUE(openRoute(path)->loop);
    keepOpen(path);
    const auto wish = openRoute(path);
    ASSERT_TRUE(wish);
    EXPECT_FALSE(wish->loop) << gap;
    ASSERT_EQ(wish->points.size(), 4U);
    EXPECT_LE((wish->points.back() - Eigen::Vector2d(1, 2)).norm(), 0.005);
    EXPECT_NEAR(wish->heading.value_or(0.0), 0.5, 1e-6);
  }
}

TEST(RouteMessages, EveryPoseAtOnePlaceIsKeptFromGoingRoundToo) {
  nav_msgs::Path path = pathOf({{1, 2, 0}, {1, 2, 0}, {1, 2, 0}, {1, 2, 0}});
  ASSERT_TRUE(openRoute(path)->loop);
  keepOpen(path);
  EXPECT_FALSE(openRoute(path)->loop);
}

TEST(RouteMessages, OtherRoutesStayAsTheyAre) {
  for (const auto& poses : {std::vector<Pose2>{},
                            {{1, 2, 0}, {3, 2, 0}, {1, 2, 0}},
                            {{1, 2, 0}, {3, 2, 0}, {3, 4, 0}, {1.002, 2, 0}}}) {
    nav_msgs::Path path = pathOf(poses);
    const nav_msgs::Path before = path;
    keepOpen(path);
    EXPECT_EQ(path, before);
  }
}

TEST(RouteMessages, AReportOnAnotherRouteIsNone) {
  RouteState state;
  state.header.stamp = ros::Time(20.0);
  state.text = "said";
  const ros::Time ordered(10.0);
  for (const std::uint8_t said : {RouteState::DRIVING, RouteState::WAITING, RouteState::REACHED,
                                  RouteState::REFUSED, RouteState::IDLE}) {
    state.state = said;
    state.route = ros::Time(9.0);
    EXPECT_EQ(reportOf(state, ordered).state, ExecutorReport::kNone) << int{said};
    state.route = ordered;
    const ExecutorReport report = reportOf(state, ordered);
    EXPECT_NE(report.state, ExecutorReport::kNone) << int{said};
    EXPECT_EQ(report.stamp, 20.0);
    EXPECT_EQ(report.text, "said");
  }
  state.state = RouteState::REACHED;
  EXPECT_EQ(reportOf(state, ordered).state, ExecutorReport::kReached);
}

TEST(RouteMessages, AnExecutorThatWasStartedAfreshIsHeardToHaveNoRoute) {
  RouteState state;
  state.state = RouteState::IDLE;
  EXPECT_EQ(reportOf(state, ros::Time(10.0)).state, ExecutorReport::kIdle);
  state.state = RouteState::REACHED;
  EXPECT_EQ(reportOf(state, ros::Time(10.0)).state, ExecutorReport::kNone);
}

}  // namespace
}  // namespace pilothouse
