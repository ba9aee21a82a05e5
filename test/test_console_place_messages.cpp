// What the console takes in about the place: maps and their pictures, poses, ways, routes; what
// lies is refused with the reason.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "doors/guarded_call.hpp"
#include "gui/model/class_colours.hpp"
#include "gui/model/conversions_place.hpp"

using namespace pilothouse;
using namespace pilothouse::gui;

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

MapGrid mapOf(std::uint32_t width, std::uint32_t height, std::uint8_t all) {
  MapGrid grid;
  grid.header.frame_id = "map";
  grid.info.resolution = 0.05F;
  grid.info.width = width;
  grid.info.height = height;
  grid.info.origin.orientation.w = 1.0;
  grid.classes.assign(std::size_t{width} * height, all);
  return grid;
}

RouteDraft square() {
  RouteDraft draft;
  const double corners[][2] = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  for (const auto& p : corners) draft.points.push_back({{{p[0], p[1]}, std::nullopt}, 0.0});
  return draft;
}

TEST(PlaceMap, aMapThatLiesIsRefusedWithTheReason) {
  const auto reason = [](void (*spoil)(MapGrid&)) {
    MapGrid grid = mapOf(10, 8, MapGrid::FREE);
    spoil(grid);
    const auto map = mapFromMessage(grid);
    return map ? std::string("taken") : map.reason();
  };
  EXPECT_EQ(reason([](MapGrid&) {}), "taken");
  EXPECT_NE(reason([](MapGrid& g) { g.classes.pop_back(); }).find("79, expected 80"),
            std::string::npos);
  EXPECT_NE(reason([](MapGrid& g) { g.classes[3] = 9; }).find("class is 9"), std::string::npos);
  EXPECT_NE(reason([](MapGrid& g) { g.info.origin.position.x = kNaN; }).find("origin"),
            std::string::npos);
  EXPECT_NE(reason([](MapGrid& g) { g.info.resolution = std::nanf(""); }).find("resolution"),
            std::string::npos);
  EXPECT_NE(reason([](MapGrid& g) { g.info.width = g.info.height = 9000; }).find("36 million"),
            std::string::npos);
}

TEST(PlaceMap, northIsUpAndAThinWallIsSeenFromAfar) {
  MapGrid grid = mapOf(1000, 500, MapGrid::FREE);
  for (std::size_t x = 0; x < 1000; ++x) grid.classes[123 * 1000 + x] = MapGrid::OCCUPIED;
  const auto map = mapFromMessage(grid);
  ASSERT_TRUE(map);
  const auto& levels = (*map)->levels;
  ASSERT_GE(levels.size(), 3U);
  EXPECT_EQ(levels[0].pixel(7, 500 - 1 - 123), mapCellColour(MapCell::kOccupied));
  EXPECT_EQ(levels[0].pixel(7, 123), mapCellColour(MapCell::kFree));
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const int row = (500 - 1 - 123) >> i;
    EXPECT_EQ(levels[i].pixel(3, row), mapCellColour(MapCell::kOccupied)) << "level " << i;
    EXPECT_EQ(levels[i].pixel(3, row - 2), mapCellColour(MapCell::kFree)) << "level " << i;
  }
}

TEST(PlaceMap, oddSizesKeepTheirLastCells) {
  MapGrid grid = mapOf(257, 301, MapGrid::UNKNOWN);
  grid.classes[256] = MapGrid::DROP_OFF;  // lower right
  const auto map = mapFromMessage(grid);
  ASSERT_TRUE(map);
  for (const auto& level : (*map)->levels) {
    EXPECT_EQ(level.pixel(level.width() - 1, level.height() - 1), mapCellColour(MapCell::kDropOff));
    EXPECT_EQ(qAlpha(level.pixel(0, 0)), 0) << "unknown is transparent";
  }
}

TEST(PlaceMessages, whatIsNotFiniteOrNotKnownIsRefused) {
  geometry_msgs::PoseWithCovarianceStamped pose;
  EXPECT_FALSE(poseFromMessage(pose)) << "an orientation of zeros is no pose";
  pose.pose.pose.orientation.w = 1.0;
  ASSERT_TRUE(poseFromMessage(pose));
  EXPECT_FALSE(poseFromMessage(pose)->spread_known) << "zeros tell nothing";
  pose.pose.covariance[0] = pose.pose.covariance[7] = 0.04;
  EXPECT_TRUE(poseFromMessage(pose)->spread_known);
  pose.pose.pose.position.y = kNaN;
  EXPECT_FALSE(poseFromMessage(pose));

  nav_msgs::Path path;
  path.poses.resize(2);
  path.poses[1].pose.position.x = 3.0;
  ASSERT_TRUE(pathFromMessage(path));
  EXPECT_DOUBLE_EQ(pathFromMessage(path)->length, 3.0);
  path.poses[1].pose.position.x = std::numeric_limits<double>::infinity();
  EXPECT_NE(pathFromMessage(path).reason().find("pose 1"), std::string::npos);

  NavigationState state;
  state.distance_left = std::nanf("");
  state.time_left = -3.0F;
  state.goal.theta = kNaN;
  ASSERT_TRUE(navigationFromMessage(state));
  EXPECT_TRUE(std::isnan(navigationFromMessage(state)->distance_left));
  EXPECT_TRUE(std::isnan(navigationFromMessage(state)->time_left));
  EXPECT_FALSE(navigationFromMessage(state)->heading);
  state.state = 9;
  EXPECT_FALSE(navigationFromMessage(state));
  TaskState task;
  task.state = 6;
  EXPECT_FALSE(taskFromMessage(task));

  PlanPath::Response response;
  response.found = 1;
  EXPECT_FALSE(previewFromResponse(response, 1)) << "a path without poses";
  response.found = 0;
  response.has_nearest = 1;
  response.nearest.x = std::nanf("");
  EXPECT_FALSE(previewFromResponse(response, 1));
}

TEST(PlaceMessages, aRouteComesBackAsItWasSent) {
  RouteDraft draft = square();
  draft.loop = true;
  draft.points[1].goal.heading = 0.5;
  draft.points[2].pause = 7.0;
  const auto back = routeFromResponse(toMessage(draft, "map"));
  ASSERT_TRUE(back) << back.reason();
  EXPECT_EQ(*back, draft);
  GoalRoute broken = toMessage(draft, "map");
  broken.points[0].x = kNaN;
  EXPECT_FALSE(routeFromResponse(broken));
  broken = toMessage(draft, "map");
  broken.points.resize(10000);
  EXPECT_NE(routeFromResponse(broken).reason().find("10000 points"), std::string::npos);
}

TEST(PlaceMessages, aResponseWhoseLengthsLieIsNeverAllocatedFor) {
  PlanPath::Response response;
  response.path.poses.resize(3);
  response.length = 2.5F;
  auto bytes = ros::serialization::serializeMessage(response);
  GuardedResponse<PlanPath::Response> read;
  ros::serialization::deserializeMessage(bytes, read);
  EXPECT_EQ(read.message.path.poses.size(), 3U);
  EXPECT_EQ(read.message.length, 2.5F);
  // found, an empty message, the path's header, then how many poses there are.
  const std::size_t count = 1 + 4 + 4 + 8 + 4;
  for (std::size_t i = 0; i < 4; ++i) bytes.message_start[count + i] = 0x7f;
  EXPECT_THROW(ros::serialization::deserializeMessage(bytes, read), std::runtime_error);
}

}  // namespace
