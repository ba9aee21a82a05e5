// Routes driven by the real motion executor on a base that accelerates as a real one does.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/motion/motion_executor.hpp"
#include "core/tasks/tasker.hpp"
#include "test/map_rooms.hpp"

namespace pilothouse {
namespace {

constexpr double kStep = 0.02;  // [s]

class RouteDrive {
 public:
  explicit RouteDrive(const MapCells& map, BaseKind kind = BaseKind::kDifferential,
                      const NavigationParameters& navigation = {})
      : planner_({}, Footprint({{0.2, 0.2}, {-0.2, 0.2}, {-0.2, -0.2}, {0.2, -0.2}}), kind),
        tasker_({planner_, navigation}),
        executor_({}, baseOf(kind)) {
    planner_.setMap(map);
  }
  static BaseParameters baseOf(BaseKind kind) {
    BaseParameters base;
    base.kind = kind;
    return base;
  }
  void drive(const std::vector<RouteStop>& stops, bool loop = false) {
    Wish wish;
    wish.behaviour = "route";
    wish.stops = stops;
    wish.loop = loop;
    const auto task = tasker_.submit(wish);
    EXPECT_TRUE(task) << task.reason();
  }
  void step() {
    now += kStep;
    ExecutorInput input;
    input.now = now;
    input.pose = pose;
    const ExecutorOutput driven = executor_.step(input);
    move(driven.wanted);
    if (++ticks_ % 5 != 0) return;
    TaskInput task;
    task.navigation.now = now;
    task.navigation.pose = pose;
    const ExecutorReport::State states[] = {ExecutorReport::kIdle, ExecutorReport::kDriving,
                                            ExecutorReport::kWaiting, ExecutorReport::kReached};
    task.navigation.executor.state = states[static_cast<std::size_t>(driven.state)];
    task.navigation.executor.stamp = now;
    output = tasker_.step(task);
    if (!output.order) return;
    ++orders;
    std::vector<Eigen::Vector2d> points;
    for (const Pose2& at : output.order->poses) points.push_back(at.position());
    executor_.drive(points, output.order->heading, false, pose);
  }
  template <class Condition>
  bool runUntil(Condition done, double seconds = 120.0) {
    const double end = now + seconds;
    while (now < end && !done()) step();
    return done();
  }
  bool ended() const { return output.task.id != 0 && output.task.phase >= TaskPhase::kDone; }
  double speed() const { return twist.linear(); }
  double off(const RouteStop& stop) const { return (pose.position() - stop.goal.place).norm(); }
  Planner& planner() { return planner_; }

  double now = 10.0;
  Pose2 pose{1.0, 1.0, 0.0};
  Twist2 twist;
  TaskerOutput output;
  int orders = 0;

 private:
  /// As fast as it may change.
  void move(const Twist2& wanted) {
    const auto toward = [](double from, double to, double most) {
      return from + std::clamp(to - from, -most, most);
    };
    twist.vx = toward(twist.vx, wanted.vx, 0.6 * kStep);
    twist.vy = toward(twist.vy, wanted.vy, 0.6 * kStep);
    twist.w = toward(twist.w, wanted.w, 2.5 * kStep);
    const double c = std::cos(pose.heading), s = std::sin(pose.heading);
    pose.x += kStep * (c * twist.vx - s * twist.vy);
    pose.y += kStep * (s * twist.vx + c * twist.vy);
    pose.heading = wrapped(pose.heading + kStep * twist.w);
  }
  Planner planner_;
  Tasker tasker_;
  MotionExecutor executor_;
  int ticks_ = 0;
};

RouteStop through(double x, double y) {
  return {{{x, y}, std::nullopt}, 0.0};
}

/// A hall of 12 x 8 m.
MapCells hall() {
  return MapRoom(240, 160).map;
}

/// The least speed from 2 s after it left until the last point is 1 m off, and how near it came to
/// each point.
double leastSpeed(RouteDrive& robot, const std::vector<RouteStop>& stops,
                  std::vector<double>& nearest) {
  nearest.assign(stops.size(), HUGE_VAL);
  double least = HUGE_VAL;
  const double since = robot.now;
  EXPECT_TRUE(robot.runUntil([&] {
    for (std::size_t i = 0; i < stops.size(); ++i) {
      nearest[i] = std::min(nearest[i], robot.off(stops[i]));
    }
    const bool near_end =
        robot.output.behaviour.point + 1 == stops.size() && robot.off(stops.back()) < 1.0;
    if (robot.now - since > 2.0 && !near_end) least = std::min(least, robot.speed());
    return robot.ended();
  })) << robot.output.task.text;
  EXPECT_EQ(robot.output.task.phase, TaskPhase::kDone) << robot.output.task.text;
  return least;
}

TEST(FollowRoute, DrivesThroughPointsInLineWithoutSlowing) {
  for (const BaseKind kind : {BaseKind::kDifferential, BaseKind::kFourWheelSteered}) {
    RouteDrive robot(hall(), kind);
    const std::vector<RouteStop> stops = {through(3.0, 1.0), through(4.0, 1.0), through(6.5, 1.0),
                                          through(10.5, 1.0)};
    robot.drive(stops);
    std::vector<double> nearest;
    EXPECT_GT(leastSpeed(robot, stops, nearest), 0.47) << "of 0.5 m/s";
    for (const double off : nearest) EXPECT_LT(off, 0.05);
  }
}

/// The least speed that the bends of a way over these points ask for, whoever drives it.
double bendSpeed(BaseKind kind, const std::vector<Eigen::Vector2d>& places, bool loop) {
  MotionExecutor executor({}, RouteDrive::baseOf(kind));
  executor.drive(places, std::nullopt, loop, {1.0, 1.0, 0.0});
  const Route& route = executor.route();
  PathTracker tracker({}, kind != BaseKind::kDifferential, HeadingMode::kFree);
  double least = HUGE_VAL;
  for (double way = 1.0; way < route.length() - (loop ? 0.0 : 1.2); way += 0.05) {
    least = std::min(least, tracker.speedAt(route, way, loop ? HUGE_VAL : route.length()));
  }
  return least;
}

std::vector<RouteStop> throughAll(const std::vector<Eigen::Vector2d>& places) {
  std::vector<RouteStop> stops;
  for (const auto& place : places) stops.push_back(through(place.x(), place.y()));
  return stops;
}

TEST(FollowRoute, SlowsAtABendNoMoreThanTheBendAsksFor) {
  const std::vector<Eigen::Vector2d> places = {{3.0, 1.0}, {5.0, 2.5}, {7.0, 2.0},
                                               {9.0, 4.0}, {8.5, 6.5}, {5.0, 6.5}};
  for (const BaseKind kind : {BaseKind::kDifferential, BaseKind::kFourWheelSteered}) {
    const double bend = bendSpeed(kind, places, false);
    ASSERT_GT(bend, 0.15);
    RouteDrive robot(hall(), kind);
    const std::vector<RouteStop> stops = throughAll(places);
    robot.drive(stops);
    std::vector<double> nearest;
    EXPECT_GT(leastSpeed(robot, stops, nearest), 0.85 * bend);
    for (const double off : nearest) EXPECT_LT(off, 0.2) << "corners are cut by 0.1 m at most";
    EXPECT_LT(robot.orders, 8);
  }
}

TEST(FollowRoute, GoesRoundALoopWithoutStanding) {
  std::vector<Eigen::Vector2d> places;
  for (int i = 0; i < 8; ++i) {
    places.emplace_back(4.5 + 2.5 * std::cos(0.7854 * i - 1.9),
                        4.0 + 2.5 * std::sin(0.7854 * i - 1.9));
  }
  const double bend = bendSpeed(BaseKind::kDifferential, places, true);
  ASSERT_GT(bend, 0.3);
  RouteDrive robot(hall());
  robot.drive(throughAll(places), true);
  ASSERT_TRUE(robot.runUntil([&] { return robot.output.behaviour.point == 3; }));
  double least = HUGE_VAL;
  int rounds = 0;
  std::size_t point = 3;
  ASSERT_TRUE(robot.runUntil([&] {
    least = std::min(least, robot.speed());
    if (robot.output.behaviour.point == 0 && point != 0) ++rounds;
    point = robot.output.behaviour.point;
    return rounds == 3;
  }));
  EXPECT_GT(least, 0.85 * bend);
}

TEST(FollowRoute, StandsWhereItShallAndDrivesOn) {
  RouteDrive robot(hall());
  std::vector<RouteStop> stops = {through(3.0, 1.0), through(5.0, 1.0), through(7.0, 1.0),
                                  through(9.0, 2.0)};
  stops[1].pause = 3.0;
  stops[2].goal.heading = 1.0;
  robot.drive(stops);
  ASSERT_TRUE(robot.runUntil(
      [&] { return robot.output.behaviour.navigation.phase == NavigationPhase::kPausing; }));
  EXPECT_EQ(robot.output.behaviour.point, 1U);
  EXPECT_LT(robot.off(stops[1]), 0.05);
  ASSERT_TRUE(robot.runUntil([&] { return robot.output.behaviour.point == 3; }));
  EXPECT_LT(robot.off(stops[2]), 0.1);
  EXPECT_NEAR(robot.pose.heading, 1.0, 0.1);
  ASSERT_TRUE(robot.runUntil([&] { return robot.ended(); }));
  EXPECT_LT(robot.off(stops[3]), 0.05);
}

TEST(FollowRoute, ABlockedLegAheadDoesNotKeepItFromTheNextPoint) {
  MapRoom room(240, 160);
  room.fill(120, 1, 122, 159);  // nothing leads beyond x = 6
  RouteDrive robot(room.map);
  const std::vector<RouteStop> stops = {through(3.0, 1.0), through(4.5, 3.0), through(9.0, 3.0)};
  robot.drive(stops);
  ASSERT_TRUE(robot.runUntil([&] { return robot.ended(); }));
  EXPECT_EQ(robot.output.task.phase, TaskPhase::kFailed);
  EXPECT_EQ(robot.output.behaviour.point, 2U);
  EXPECT_EQ(robot.output.task.text.rfind("point 3 of 3: ", 0), 0U) << robot.output.task.text;
}

TEST(FollowRoute, ANarrowPassDistanceIsKept) {
  NavigationParameters navigation;
  navigation.pass_distance = 0.06;
  RouteDrive robot(hall(), BaseKind::kDifferential, navigation);
  const std::vector<RouteStop> stops = {through(3.0, 1.0), through(3.0, 3.0), through(5.0, 3.0)};
  robot.drive(stops);
  std::vector<double> nearest;
  leastSpeed(robot, stops, nearest);
  for (const double off : nearest) EXPECT_LT(off, 0.07);
}

}  // namespace
}  // namespace pilothouse
