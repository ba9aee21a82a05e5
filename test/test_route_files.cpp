// Routes that come in as messages and files.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "doors/goal_views.hpp"
#include "doors/route_files.hpp"
#include "test/own_folder.hpp"

namespace pilothouse {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::string folder() {
  return ownFolder() + "/routes";
}

GoalRoute someRoute() {
  GoalRoute route;
  route.header.frame_id = "map";
  route.loop = 1;
  for (int i = 0; i < 5; ++i) {
    RoutePoint point;
    point.x = 0.1 * i + 1.0 / 3.0;
    point.y = -2.0 * i;
    point.heading = i % 2 == 0 ? kNan : 0.25 * i;
    point.pause = i == 3 ? 2.5F : 0.0F;
    route.points.push_back(point);
  }
  return route;
}

/// The reason why a file with that text is refused.
std::string refusalOf(const std::string& text) {
  saveRoute(folder(), "bad", someRoute());  // makes the folder
  std::ofstream(folder() + "/bad.yaml") << text;
  return loadRoute(folder(), "bad").reason();
}

TEST(RouteFiles, KeepWhatWasSaved) {
  saveRoute(folder(), "some-route_1", someRoute());
  const auto loaded = loadRoute(folder(), "some-route_1");
  ASSERT_TRUE(loaded) << loaded.reason();
  EXPECT_EQ(loaded->name, "some-route_1");
  EXPECT_EQ(loaded->loop, 1);
  EXPECT_EQ(loaded->header.frame_id, "map");
  ASSERT_EQ(loaded->points.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(loaded->points[i].x, someRoute().points[i].x, 1e-8);
    EXPECT_EQ(std::isnan(loaded->points[i].heading), i % 2 == 0);
    EXPECT_EQ(loaded->points[i].pause, someRoute().points[i].pause);
  }
  const auto names = routesIn(folder());
  EXPECT_NE(std::find(names.begin(), names.end(), "some-route_1"), names.end());
  EXPECT_TRUE(routesIn(folder() + "/none").empty());
}

TEST(RouteFiles, RefuseBadNamesAndBadRoutesAndKeepTheOld) {
  for (const std::string name : {"", "../up", "a b", "a.yaml", "a/b"}) {
    EXPECT_THROW(saveRoute(folder(), name, someRoute()), std::runtime_error) << name;
    EXPECT_FALSE(loadRoute(folder(), name)) << name;
  }
  saveRoute(folder(), "kept", someRoute());
  GoalRoute bad = someRoute();
  bad.points[2].x = kNan;
  EXPECT_THROW(saveRoute(folder(), "kept", bad), std::runtime_error);
  bad.points.assign(10000, RoutePoint());
  EXPECT_THROW(saveRoute(folder(), "kept", bad), std::runtime_error);
  EXPECT_EQ(loadRoute(folder(), "kept")->points.size(), 5U);
}

TEST(RouteFiles, NameWhatIsWrong) {
  const auto has = [](const std::string& text, const std::string& part) {
    const std::string reason = refusalOf(text);
    EXPECT_NE(reason.find(part), std::string::npos) << reason;
    EXPECT_NE(reason.find("bad.yaml"), std::string::npos) << reason;
  };
  has("loop: false\n", "points is missing");
  has("points: 7\n", "expected a list");
  has("points: []\n", "no points, expected at least one");
  has("points: [{x: 1.0}]\n", "points[0]: y is missing");
  has("points: [{x: 1.0, y: a}]\n", "y is \"a\"");
  has("points: [{x: 1.0, y: .nan}]\n", "expected a number");
  has("points: [{x: 1.0, y: 1.0, speed: 3.0}]\n", "speed");
  has("points: [{x: 1.0, y: 1.0, pause: -3.0}]\n", "pause is -3, expected 0 to 3600 s");
  has("points: [{x: 1.0e9, y: 1.0}]\n", "expected within 10000 m");
  has("points: [7]\n", "expected named parameters");
  has("loop: maybe\npoints: [{x: 1.0, y: 1.0}]\n", "loop is \"maybe\"");
  has("[1, 2]\n", "expected keys with values");
  has("points: [{x: 1.0", "not YAML");
  std::string many = "points:\n";
  for (int i = 0; i < 10000; ++i) many += "  - {x: 1.0, y: 1.0}\n";
  has(many, "points, expected at most 1000");
  EXPECT_NE(loadRoute(folder(), "not_there").reason().find("cannot be read"), std::string::npos);
}

TEST(GoalViews, RefuseWhatNoRobotCanDriveTo) {
  geometry_msgs::PoseStamped pose;
  EXPECT_TRUE(openGoal(pose));
  EXPECT_FALSE(openGoal(pose)->heading) << "zeros: any heading";
  pose.pose.orientation.z = 1.0;
  EXPECT_NEAR(std::abs(*openGoal(pose)->heading), 3.14159, 1e-4);
  pose.pose.orientation.w = 1.0;
  EXPECT_NE(openGoal(pose).reason().find("expected a unit quaternion"), std::string::npos);
  pose.pose.orientation.w = kNan;
  EXPECT_FALSE(openGoal(pose));
  pose.pose.orientation.w = 0.0;
  pose.pose.position.x = kNan;
  EXPECT_EQ(openGoal(pose).reason(), "goal: place is nan 0, expected within 10000 m");
  pose.pose.position.x = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(openGoal(pose));
}

TEST(GoalViews, MoveGoalsBetweenFrames) {
  const Goal there = moved({1.0, 2.0, 1.5707963}, {{1.0, 0.0}, 0.5});
  EXPECT_NEAR(there.place.x(), 1.0, 1e-6);
  EXPECT_NEAR(there.place.y(), 3.0, 1e-6);
  EXPECT_NEAR(*there.heading, 2.0707963, 1e-6);
}

}  // namespace
}  // namespace pilothouse
