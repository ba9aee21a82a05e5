#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/tasks/tasker.hpp"
#include "test/map_rooms.hpp"

namespace pilothouse {

/// Planner, tasker and a robot of 0.4 m that drives what it is ordered to, at 0.5 m/s.
class TaskHarness {
 public:
  static constexpr double kStep = 0.1;  ///< [s]

  explicit TaskHarness(const MapCells& map, const NavigationParameters& parameters = {})
      : planner({}, Footprint({{0.2, 0.2}, {-0.2, 0.2}, {-0.2, -0.2}, {0.2, -0.2}}),
                BaseKind::kFourWheelSteered),
        tasker({planner, parameters}) {
    planner.setMap(map);
    pose = {1.0, 1.5, 0.0};
  }

  std::uint32_t goTo(double x, double y, std::optional<double> heading = std::nullopt) {
    Wish wish;
    wish.behaviour = "go_to";
    wish.stops = {{{{x, y}, heading}, 0.0}};
    const auto task = tasker.submit(wish);
    EXPECT_TRUE(task) << task.reason();
    return task ? *task : 0;
  }

  /// A person begins to drive.
  void takeOver() {
    Wish wish;
    wish.behaviour = "hand";
    EXPECT_TRUE(tasker.submit(wish));
    hand = true;
    step();
  }

  void step() {
    now += kStep;
    move();
    TaskInput input;
    input.navigation.now = now;
    if (localised) input.navigation.pose = pose;
    input.navigation.executor = report;
    input.navigation.halted = halted;
    input.hand = hand;
    output = tasker.step(input);
    for (const auto& task : output.ended) ended.push_back(task);
    phases.push_back(output.behaviour.navigation.phase);
    if (!output.order) return;
    order = *output.order;
    ++orders;
    at = 1;
    report.state = order.poses.empty() ? ExecutorReport::kIdle : ExecutorReport::kDriving;
    if (order.poses.size() == 1) ++turns;
  }
  template <class Condition>
  bool runUntil(Condition done, double seconds = 120.0) {
    const double end = now + seconds;
    while (now < end && !done()) step();
    return done();
  }
  bool runToEnd(double seconds = 200.0) {
    return runUntil([this] { return output.task.id != 0 && output.task.phase >= TaskPhase::kDone; },
                    seconds);
  }
  NavigationPhase phase() const { return output.behaviour.navigation.phase; }
  bool was(NavigationPhase which) const {
    return std::find(phases.begin(), phases.end(), which) != phases.end();
  }

  Planner planner;
  Tasker tasker;
  double now = 100.0;
  Pose2 pose;
  ExecutorReport report;
  bool localised = true, halted = false, hand = false;
  bool held = false;   ///< nothing lets it drive on; it can turn and go back
  bool looks = false;  ///< goes back to look at what holds it
  DriveOrder order;
  int orders = 0, turns = 0;
  TaskerOutput output;
  std::vector<TaskReport> ended;
  std::vector<NavigationPhase> phases;

 private:
  void move() {
    report.stamp = now;
    report.text.clear();
    if (order.poses.empty()) return;
    if (looks && order.poses.size() > 1) {
      report.state = ExecutorReport::kDriving;
      report.text = "looks again";
      pose.heading += 0.05;  // it turns to what it looks at
      return;
    }
    const bool stays = halted || (held && order.poses.size() > 1);
    if (stays) {
      report.state = ExecutorReport::kWaiting;
      report.text = "held: seen by camera at 0.30 m";
      return;
    }
    report.state = ExecutorReport::kDriving;
    for (double way = 0.5 * kStep; at < order.poses.size();) {
      const Eigen::Vector2d leg = order.poses[at].position() - pose.position();
      const double go = std::min(way, leg.norm());
      if (leg.norm() > 1e-9) {
        pose.x += go / leg.norm() * leg.x();
        pose.y += go / leg.norm() * leg.y();
        pose.heading = std::atan2(leg.y(), leg.x());
      }
      way -= go;
      if (leg.norm() > go + 1e-9) return;
      ++at;
    }
    if (order.heading) pose.heading = *order.heading;
    report.state = ExecutorReport::kReached;
  }
  std::size_t at = 1;
};

inline MapRoom hall() {
  MapRoom room(120, 60);
  room.fill(60, 1, 62, 18);
  room.fill(60, 42, 62, 59);  // a door of 1.2 m
  return room;
}

}  // namespace pilothouse
