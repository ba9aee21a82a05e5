#include "core/planning/planner.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "bench/shortest_way.hpp"
#include "test/map_rooms.hpp"

namespace pilothouse {
namespace {

constexpr double kPi = 3.14159265358979;

Footprint disc(double radius) {
  std::vector<Eigen::Vector2d> corners;
  for (int i = 0; i < 32; ++i) {
    // Its inscribed circle has the radius.
    const double r = radius / std::cos(kPi / 32.0);
    corners.emplace_back(r * std::cos(i * kPi / 16.0), r * std::sin(i * kPi / 16.0));
  }
  return Footprint(corners);
}
Footprint box(double half_x, double half_y) {
  return Footprint({{half_x, half_y}, {-half_x, half_y}, {-half_x, -half_y}, {half_x, -half_y}});
}
Planner roundPlanner(const PlanningParameters& parameters = {}) {
  return Planner(parameters, disc(0.2), BaseKind::kDifferential);
}
PlanRequest from(double x, double y, double to_x, double to_y) {
  PlanRequest request;
  request.start = {x, y, 0.0};
  request.goal = {to_x, to_y};
  return request;
}

/// Least distance from the outline to anything occupied or a drop-off along the rounded way, from
/// scratch; negative: it touches.
double leastGap(const Planner& planner, const Footprint& footprint, const Plan& plan, bool turns) {
  std::vector<Eigen::Vector2d> points;
  for (const Pose2& pose : plan.poses) points.push_back(pose.position());
  const Route route(points, planner.parameters().corners);
  const MapCells& map = planner.map();
  double least = 10.0;
  for (double way = 0.0; way <= route.length(); way += 0.03) {
    const Route::Place place = route.at(way);
    const Pose2 pose{
        place.position.x(), place.position.y(),
        turns ? std::atan2(place.direction.y(), place.direction.x()) : plan.poses.front().heading};
    const int row = map.row(pose.y), column = map.column(pose.x);
    for (int y = row - 15; y <= row + 15; ++y) {
      for (int x = column - 15; x <= column + 15; ++x) {
        if (map.at(x, y) != MapCell::kOccupied && map.at(x, y) != MapCell::kDropOff) continue;
        const double gap = footprint.distanceTo(pose.toBase({map.centreX(x), map.centreY(y)}));
        least = std::min(least, gap - 0.5 * map.cell_size);
      }
    }
  }
  return least;
}

/// Length of the shortest way of a disc's middle in the room.
double shortestAmong(const MapRoom& room, double radius, const Eigen::Vector2d& start,
                     const Eigen::Vector2d& goal) {
  const double x = room.cell * room.map.size_x, y = room.cell * room.map.size_y, wall = room.cell;
  std::vector<FloorBox> boxes = room.boxes;
  boxes.insert(boxes.end(), {{{0.0, 0.0}, {x, wall}},
                             {{0.0, y - wall}, {x, y}},
                             {{0.0, 0.0}, {wall, y}},
                             {{x - wall, 0.0}, {x, y}}});
  std::vector<bench::ConvexShape> shapes;
  for (const FloorBox& box : boxes) {
    shapes.emplace_back(std::vector<Eigen::Vector2d>{
        box.low, {box.high.x(), box.low.y()}, box.high, {box.low.x(), box.high.y()}});
  }
  return bench::shortestWay(shapes, radius, start, goal);
}

TEST(Planner, GoesStraightWhereNothingStands) {
  Planner planner = roundPlanner();
  planner.setMap(MapRoom(100, 100).map);
  const Plan plan = planner.plan(from(1.0, 1.0, 4.0, 2.5));
  ASSERT_TRUE(plan) << textOf(plan.why);
  ASSERT_EQ(plan.poses.size(), 2U);
  EXPECT_NEAR(plan.length, std::hypot(3.0, 1.5), 1e-6);
  EXPECT_NEAR(plan.poses[0].heading, std::atan2(1.5, 3.0), 1e-6);
  EXPECT_EQ(plan.poses.back().position(), Eigen::Vector2d(4.0, 2.5));
}

TEST(Planner, IsWithinFivePercentOfTheShortestWay) {
  std::mt19937 random(5);
  Planner planner = roundPlanner();
  const double radius = planner.field().least();
  int judged = 0;
  double sum = 0.0, worst = 0.0;
  for (int run = 0; run < 60; ++run) {
    MapRoom room(120, 100);
    room.addBoxes(random, 6);
    planner.setMap(room.map);
    const auto place = [&](double most) {
      return 0.4 + (most - 0.8) * static_cast<double>(random() % 1000) / 1000.0;
    };
    const PlanRequest request = from(place(6.0), place(5.0), place(6.0), place(5.0));
    if (planner.field().weight(room.map.column(request.start.x), room.map.row(request.start.y)) ==
        0)
      continue;
    const Plan plan = planner.plan(request);
    if (!plan || (request.goal - request.start.position()).norm() < 1.0) continue;
    // What a grid cannot know, half a cell, the shortest way must have to spare.
    const Eigen::Vector2d start = request.start.position();
    const double shortest = shortestAmong(room, radius + 0.025, start, request.goal);
    if (!std::isfinite(shortest)) continue;
    EXPECT_LE(plan.length, 1.05 * shortest) << "run " << run;
    EXPECT_GE(plan.length, 0.999 * shortestAmong(room, radius - 0.036, start, request.goal));
    sum += plan.length / shortest;
    worst = std::max(worst, plan.length / shortest);
    ++judged;
  }
  ASSERT_GT(judged, 25);
  EXPECT_LE(sum / judged, 1.01) << "worst " << worst;
  RecordProperty("worst_permille", static_cast<int>(1000.0 * worst));
  std::printf("length over the shortest: mean %.4f, worst %.4f of %d\n", sum / judged, worst,
              judged);
}

TEST(Planner, KeepsEveryOutlineOffThings) {
  struct Case {
    Footprint footprint;
    BaseKind base;
    HeadingMode heading;
  };
  const std::vector<Case> cases = {
      {disc(0.18), BaseKind::kDifferential, HeadingMode::kFree},
      {box(0.25, 0.2), BaseKind::kFourWheelSteered, HeadingMode::kFree},
      {box(0.25, 0.2), BaseKind::kFourWheelSteered, HeadingMode::kKept},
      {box(0.45, 0.15), BaseKind::kDifferential, HeadingMode::kFree}};
  std::mt19937 random(6);
  for (const Case& c : cases) {
    PlanningParameters parameters;
    parameters.heading = c.heading;
    Planner planner(parameters, c.footprint, c.base);
    const bool turns = c.heading == HeadingMode::kFree;
    int found = 0;
    for (int run = 0; run < 120; ++run) {
      MapRoom room(100, 100);
      room.addBoxes(random, 14);
      planner.setMap(room.map);
      const auto place = [&] { return 0.5 + 4.0 * static_cast<double>(random() % 1000) / 1000.0; };
      const PlanRequest request = from(place(), place(), place(), place());
      const int column = room.map.column(request.start.x), row = room.map.row(request.start.y);
      if (planner.field().clearance(column, row) < planner.check().ample()) continue;
      const Plan plan = planner.plan(request);
      if (!plan) continue;
      ++found;
      EXPECT_GE(leastGap(planner, c.footprint, plan, turns), 0.0) << "run " << run;
      EXPECT_TRUE(planner.free(plan.poses));
    }
    EXPECT_GT(found, 10);
  }
}

TEST(Planner, SaysWhyThereIsNoWayAndHowFarItCanGo) {
  MapRoom room(120, 60);
  room.fill(60, 1, 62, 59);
  Planner planner = roundPlanner();
  planner.setMap(room.map);
  Plan plan = planner.plan(from(1.0, 1.5, 5.0, 1.5));
  EXPECT_EQ(plan.why, NoWay::kWalledOff);
  ASSERT_TRUE(plan.nearest);
  EXPECT_NEAR(plan.nearest->x(), 2.675, 0.03) << "as near to the wall as it may";
  EXPECT_NEAR(plan.nearest->y(), 1.5, 0.06);

  room.fill(60, 28, 62, 34);  // still closed
  room.fill(60, 28, 62, 34, MapCell::kFree);
  planner.setMap(room.map);
  EXPECT_EQ(planner.plan(from(1.0, 1.5, 5.0, 1.5)).why, NoWay::kTooNarrow);

  room.fill(55, 1, 65, 59, MapCell::kDropOff);
  planner.setMap(room.map);
  plan = planner.plan(from(1.0, 1.5, 5.0, 1.5));
  EXPECT_EQ(plan.why, NoWay::kOnlyOverDropOff);
  ASSERT_TRUE(plan.nearest);
  EXPECT_LT(plan.nearest->x(), 2.5);

  room.fill(55, 1, 65, 59, MapCell::kUnknown);
  planner.setMap(room.map);
  EXPECT_TRUE(planner.plan(from(1.0, 1.5, 5.0, 1.5))) << "unknown floor is trusted by default";
  PlanningParameters careful;
  careful.unknown = UnknownFloor::kNever;
  Planner never = roundPlanner(careful);
  never.setMap(room.map);
  EXPECT_EQ(never.plan(from(1.0, 1.5, 5.0, 1.5)).why, NoWay::kOnlyThroughUnknown);
  EXPECT_EQ(never.plan(from(1.0, 1.5, 3.0, 1.5)).why, NoWay::kGoalUnknown);
}

TEST(Planner, SaysTheSameReasonBothWays) {
  // Shut in, or shut out: the lesser side is looked at first, whichever that is.
  for (const MapCell kind : {MapCell::kOccupied, MapCell::kDropOff}) {
    MapRoom room(120, 60);
    room.fill(1, 1, 42, 42, kind);
    room.fill(1, 1, 30, 30, MapCell::kFree);
    Planner planner = roundPlanner();
    planner.setMap(room.map);
    const NoWay out = planner.plan(from(0.8, 0.8, 5.0, 2.0)).why;
    EXPECT_EQ(out, kind == MapCell::kOccupied ? NoWay::kWalledOff : NoWay::kOnlyOverDropOff);
    EXPECT_EQ(planner.plan(from(5.0, 2.0, 0.8, 0.8)).why, out);
  }
}

TEST(Planner, RefusesEndsThatCannotBe) {
  Planner planner = roundPlanner();
  EXPECT_EQ(planner.plan(from(1.0, 1.0, 2.0, 2.0)).why, NoWay::kNoMap);
  MapRoom room(100, 100);
  room.addBox(60, 60, 70, 70);
  room.fill(60, 20, 70, 30, MapCell::kDropOff);
  planner.setMap(room.map);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(planner.plan(from(nan, 1.0, 2.0, 2.0)).why, NoWay::kNotFinite);
  EXPECT_EQ(planner.plan(from(1.0, 1.0, 2.0, nan)).why, NoWay::kNotFinite);
  PlanRequest turned = from(1.0, 1.0, 2.0, 2.0);
  turned.heading = nan;
  EXPECT_EQ(planner.plan(turned).why, NoWay::kNotFinite);
  EXPECT_EQ(planner.plan(from(1e300, 1.0, 2.0, 2.0)).why, NoWay::kNotFinite);
  EXPECT_EQ(planner.plan(from(-1.0, 1.0, 2.0, 2.0)).why, NoWay::kStartOutside);
  Plan plan = planner.plan(from(1.0, 1.0, 90.0, 1.0));
  EXPECT_EQ(plan.why, NoWay::kGoalOutside);
  ASSERT_TRUE(plan.nearest);
  EXPECT_GT(plan.nearest->x(), 4.5);
  EXPECT_EQ(planner.plan(from(1.0, 1.0, 3.25, 3.25)).why, NoWay::kGoalOccupied);
  EXPECT_EQ(planner.plan(from(1.0, 1.0, 3.25, 1.25)).why, NoWay::kGoalDropOff);
  plan = planner.plan(from(1.0, 1.0, 2.9, 3.25));
  EXPECT_EQ(plan.why, NoWay::kGoalTight);
  ASSERT_TRUE(plan.nearest);
  EXPECT_LT((*plan.nearest - Eigen::Vector2d(2.9, 3.25)).norm(), 0.25);
  MapRoom cell(100, 100);
  cell.fill(10, 10, 30, 30);
  cell.fill(17, 17, 23, 23, MapCell::kFree);
  planner.setMap(cell.map);
  EXPECT_EQ(planner.plan(from(1.0, 1.0, 3.0, 3.0)).why, NoWay::kStartBlocked);
  EXPECT_THROW(planner.setMap(MapCells{}), std::invalid_argument);
}

TEST(Planner, TakesWhatLiesOutsideTheMapForFloorThatNobodyHasSeen) {
  MapRoom room(100, 100);
  room.fill(99, 40, 100, 60, MapCell::kFree);  // a door at the map's edge
  Planner planner = roundPlanner();
  planner.setMap(room.map);
  const Plan plan = planner.plan(from(1.0, 2.5, 8.0, 2.5));
  ASSERT_TRUE(plan) << textOf(plan.why);
  EXPECT_NEAR(plan.length, 7.0, 0.1);
  planner.setMap(room.map);
  EXPECT_TRUE(planner.map().contains(planner.map().column(8.0), planner.map().row(2.5)))
      << "the next map is laid out for that goal too";

  PlanningParameters careful;
  careful.unknown = UnknownFloor::kNever;
  Planner never = roundPlanner(careful);
  never.setMap(room.map);
  EXPECT_EQ(never.plan(from(1.0, 2.5, 8.0, 2.5)).why, NoWay::kGoalOutside);
  EXPECT_EQ(never.plan(from(1.0, 2.5, 4.85, 2.5)).why, NoWay::kGoalTight) << "too near the edge";
}

TEST(Planner, GoesOnAlongWhatItStandsTooNearTo) {
  MapRoom room(120, 60);
  Planner planner({}, box(0.25, 0.2), BaseKind::kDifferential);
  planner.setMap(room.map);
  // Beside the wall, where it cannot turn: 0.27 m from its middle to the wall's face.
  const Plan plan = planner.plan(from(2.0, 0.32, 4.0, 0.8));
  ASSERT_TRUE(plan) << textOf(plan.why);
  const Eigen::Vector2d first = plan.poses[1].position() - plan.poses[0].position();
  EXPECT_LT(std::abs(std::atan2(first.y(), first.x())), 0.8) << "not square away from it";
}

TEST(Planner, KnowsAWayThatIsFreeButTight) {
  MapRoom room(120, 60);
  Planner planner({}, box(0.25, 0.2), BaseKind::kDifferential);
  planner.setMap(room.map);
  const Plan plan = planner.plan(from(1.0, 1.51, 4.0, 1.51));
  ASSERT_TRUE(plan);
  EXPECT_TRUE(planner.roomy(plan.poses));
  planner.mark({{{2.5, 1.78}, 0.02}});
  EXPECT_TRUE(planner.free(plan.poses));
  EXPECT_FALSE(planner.roomy(plan.poses));
}

TEST(Planner, GetsAwayFromWhatItStandsTooNearTo) {
  MapRoom room(100, 100);
  Planner planner = roundPlanner();
  planner.setMap(room.map);
  const PlanRequest request = from(0.2, 2.0, 4.0, 2.0);
  ASSERT_EQ(planner.field().weight(room.map.column(0.2), room.map.row(2.0)), 0);
  const Plan plan = planner.plan(request);
  ASSERT_TRUE(plan) << textOf(plan.why);
  EXPECT_EQ(plan.poses.front().position(), request.start.position());
  EXPECT_LT(plan.length, 3.85);
}

TEST(Planner, GoesRoundAMarkAndBackWhenItIsGone) {
  MapRoom room(100, 60);
  room.fill(50, 1, 52, 20);
  room.fill(50, 40, 52, 59);  // a door of 1 m in the middle
  Planner planner = roundPlanner();
  planner.setMap(room.map);
  const PlanRequest request = from(1.0, 1.5, 4.0, 1.5);
  const Plan before = planner.plan(request);
  ASSERT_TRUE(before);
  ASSERT_TRUE(planner.free(before.poses));
  EXPECT_FALSE(planner.mark({}));
  ASSERT_TRUE(planner.mark({{{1.7, 1.5}, 0.1}}));
  EXPECT_FALSE(planner.mark({{{1.7, 1.5}, 0.1}})) << "the same again changes nothing";
  EXPECT_FALSE(planner.free(before.poses));
  const Plan round = planner.plan(request);
  ASSERT_TRUE(round);
  EXPECT_GT(round.length, before.length + 0.02);
  EXPECT_TRUE(planner.free(round.poses));
  planner.mark({{{2.55, 1.5}, 0.2}});
  EXPECT_EQ(planner.plan(request).why, NoWay::kTooNarrow) << "the door is blocked";
  planner.mark({});
  const Plan after = planner.plan(request);
  ASSERT_TRUE(after);
  EXPECT_EQ(after.length, before.length);
}

TEST(Planner, PlansAnewAsAPlannerThatHasJustComeWould) {
  std::mt19937 random(9);
  const auto uniform = [&random](double low, double high) {
    return low + (high - low) * static_cast<double>(random() % 1000) / 1000.0;
  };
  int found = 0, none = 0;
  for (int run = 0; run < 40; ++run) {
    MapRoom room(120, 100);
    room.addBoxes(random, 10);
    Planner kept({}, box(0.35, 0.15), BaseKind::kDifferential);
    kept.setMap(room.map);
    PlanRequest request =
        from(uniform(0.4, 5.6), uniform(0.4, 4.6), uniform(0.4, 5.6), uniform(0.4, 4.6));
    for (int step = 0; step < 12; ++step) {
      std::vector<Planner::Mark> marks;
      for (auto i = random() % 4; i > 0; --i) {
        marks.push_back({{uniform(0.0, 6.0), uniform(0.0, 5.0)}, uniform(0.0, 0.4)});
      }
      if (random() % 4 == 0) {
        room.addBoxes(random, 1);
        kept.setMap(room.map);
      }
      kept.mark(marks);
      Planner fresh({}, box(0.35, 0.15), BaseKind::kDifferential);
      fresh.setMap(room.map);
      fresh.mark(marks);
      const Plan plan = kept.plan(request), expected = fresh.plan(request);
      ASSERT_EQ(plan.why, expected.why) << "run " << run << ", step " << step;
      ASSERT_EQ(plan.length, expected.length) << "run " << run << ", step " << step;
      ASSERT_EQ(plan.cost, expected.cost);
      ASSERT_EQ(plan.nearest, expected.nearest);
      ASSERT_EQ(kept.planAmong({}, request).length, fresh.planAmong({}, request).length);
      ++(plan ? found : none);
      if (plan && plan.length > 0.5) {
        std::vector<Eigen::Vector2d> points;
        for (const Pose2& pose : plan.poses) points.push_back(pose.position());
        const Route::Place next = Route(points, kept.parameters().corners).at(0.2);
        request.start = {next.position.x(), next.position.y(),
                         std::atan2(next.direction.y(), next.direction.x())};
      }
    }
  }
  EXPECT_GT(found, 150);
  EXPECT_GT(none, 20);
}

TEST(Planner, CrossesAThresholdOnlyWhereTheWayRoundIsMuchLonger) {
  MapRoom room(120, 100);
  room.fill(60, 1, 62, 60);
  room.fill(60, 20, 62, 50, MapCell::kThreshold);
  PlanningParameters parameters;
  parameters.threshold_cost = 6.0;
  Planner planner = roundPlanner(parameters);
  planner.setMap(room.map);
  const auto crosses = [&](const Plan& plan) {
    for (std::size_t i = 1; i < plan.poses.size(); ++i) {
      for (double t = 0.0; t <= 1.0; t += 0.002) {
        const Eigen::Vector2d p =
            (1.0 - t) * plan.poses[i - 1].position() + t * plan.poses[i].position();
        if (room.map.at(room.map.column(p.x()), room.map.row(p.y())) == MapCell::kThreshold)
          return true;
      }
    }
    return false;
  };
  const Plan low = planner.plan(from(1.0, 1.5, 5.0, 1.5));
  ASSERT_TRUE(low);
  EXPECT_TRUE(crosses(low));
  const Plan high = planner.plan(from(2.0, 3.3, 4.0, 3.3));
  ASSERT_TRUE(high);
  EXPECT_FALSE(crosses(high));
}

TEST(Planner, TurnsAtTheGoalOnlyWhereThereIsRoom) {
  MapRoom room(100, 40);
  room.fill(50, 1, 100, 13);
  room.fill(50, 26, 100, 40);  // a corridor of 0.65 m
  PlanningParameters parameters;
  Planner planner(parameters, box(0.35, 0.2), BaseKind::kFourWheelSteered);
  planner.setMap(room.map);
  PlanRequest request = from(1.0, 1.0, 3.5, 0.975);
  EXPECT_TRUE(planner.plan(request));
  request.heading = 0.0;
  EXPECT_TRUE(planner.plan(request));
  request.heading = 0.5 * kPi;
  EXPECT_EQ(planner.plan(request).why, NoWay::kGoalHeadingTight);
  request = from(1.0, 1.0, 1.5, 0.975);
  request.heading = 0.5 * kPi;
  EXPECT_TRUE(planner.plan(request));
}

TEST(Planner, GivesHeadingsThatTheBaseCanDrive) {
  MapRoom room(100, 100);
  room.addBox(40, 1, 45, 70);
  PlanRequest request = from(1.0, 1.0, 4.0, 1.0);
  request.start.heading = 1.0;
  request.heading = -2.0;
  Planner turning = roundPlanner();
  turning.setMap(room.map);
  const Plan along = turning.plan(request);
  ASSERT_TRUE(along);
  for (std::size_t i = 0; i + 1 < along.poses.size(); ++i) {
    const Eigen::Vector2d leg = along.poses[i + 1].position() - along.poses[i].position();
    EXPECT_NEAR(along.poses[i].heading, std::atan2(leg.y(), leg.x()), 1e-9);
  }
  EXPECT_EQ(along.poses.back().heading, -2.0);
  PlanningParameters parameters;
  parameters.heading = HeadingMode::kKept;
  Planner kept(parameters, box(0.25, 0.2), BaseKind::kOmnidirectional);
  kept.setMap(room.map);
  const Plan keeps = kept.plan(request);
  ASSERT_TRUE(keeps);
  for (std::size_t i = 0; i + 1 < keeps.poses.size(); ++i) EXPECT_EQ(keeps.poses[i].heading, 1.0);
}

TEST(PlanningParameters, NameEveryFault) {
  PlanningParameters parameters;
  parameters.clearance = -1.0;
  parameters.escape = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(validate(parameters).size(), 2U);
  EXPECT_THROW(roundPlanner(parameters), std::invalid_argument);
}

}  // namespace
}  // namespace pilothouse
