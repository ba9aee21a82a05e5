#include "bench/original_experiments.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "bench/original_judging.hpp"
#include "core/motion/swept_path.hpp"
#include "doors/package_files.hpp"
#include "sim/world_file.hpp"

namespace pilothouse::bench {
namespace {

constexpr double kRest = 1.0;        // the robot stands first, so that it has looked [s]
constexpr double kAroundIt = 0.08;   // what is so near a model belongs to it [m]
constexpr double kInsideIt = -0.08;  // cells so far within a ramp are not its edges [m]
constexpr double kLater = 1.2;       // [s]
constexpr int kEnoughCells = 3;      // of an obstacle make it one

std::string said(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

sim::World worldOf(const std::string& name) {
  const auto loaded = sim::loadWorld(packageFile("maps/" + name + ".sdf"));
  if (!loaded) throw std::runtime_error(loaded.reason());
  return loaded->world;
}

DriveLoopParameters parametersOf(std::uint64_t seed) {
  DriveLoopParameters parameters;
  parameters.simulation.seed = seed;
  return parameters;
}

/// The original method has one limit: what is above is an obstacle, the rest floor.
RobotDescription withOriginalMethod(RobotDescription robot, double limit) {
  robot.floor.method = FloorMethod::kOriginal;
  robot.floor.threshold_deviation = std::min(robot.floor.threshold_deviation, limit);
  robot.floor.obstacle_deviation = limit;
  return robot;
}

bool never(const DriveSample&, const DriveStep&) {
  return false;
}

/// For a second, after it has set out.
DriveRecorder::Condition standsAgain() {
  int standing = 0;
  return [standing](const DriveSample& s, const DriveStep&) mutable {
    standing = s.time > 4.0 && s.measured < 0.003 ? standing + 1 : 0;
    return standing > 50;
  };
}

/// Stands for a while, then wants `twist`.
/// @param moment kept so long after that [s]
DriveRecord driveStraight(const sim::World& world, const RobotDescription& robot,
                          std::uint64_t seed, const Twist2& twist, double seconds, double moment,
                          const DriveRecorder::Condition& end) {
  DriveLoop loop(world, robot, parametersOf(seed));
  DriveRecorder recorder(loop);
  recorder.run(kRest, never, [](const DriveSample&, const DriveStep&) { return false; });
  recorder.record().has_moment = false;
  loop.want(twist);
  recorder.run(seconds, end, [&](const DriveSample& sample, const DriveStep&) {
    return sample.time >= kRest + moment;
  });
  return recorder.record();
}

void judgeBox(Experiment& experiment, const sim::World& world, const std::string& model,
              const std::string& what, bool obstacle) {
  const CellCount cells = countCells(experiment.record.moment, outlineOf(world, model, kAroundIt));
  const bool is = cells.obstacle >= kEnoughCells;
  experiment.findings.push_back(
      {what, obstacle ? "obstacle" : "floor",
       (is ? "obstacle, " : "floor, ") + std::to_string(cells.obstacle) + " cells above the limit",
       obstacle ? is : cells.obstacle == 0});
}

void judgeContacts(Experiment& experiment) {
  experiment.findings.push_back({"contacts", "0", std::to_string(experiment.record.contacts),
                                 experiment.record.contacts == 0});
}

/// Boxes of 18 and 7 cm, judged by the deviation of heights alone.
Experiment boxes(const RobotDescription& platform, std::uint64_t seed, double limit,
                 const std::string& name) {
  const sim::World world = worldOf("experiment_boxes");
  Experiment e;
  e.name = name;
  e.robot = withOriginalMethod(platform, limit);
  e.record = driveStraight(world, e.robot, seed, {0.3, 0.0, 0.0}, 14.0, 0.1,
                           [](const DriveSample& s, const DriveStep&) { return s.pose.x > 2.2; });
  const bool low_is_one = limit < 0.02;
  judgeBox(e, world, "high_box", "box of 18 cm at 1.9 m", true);
  judgeBox(e, world, "low_box", "box of 7 cm at 1.9 m", low_is_one);
  judgeBox(e, world, "far_high_box", "box of 18 cm at 3 m", true);
  judgeBox(e, world, "far_low_box", "box of 7 cm at 3 m", low_is_one);
  judgeContacts(e);
  e.figure.title = "Boxes of 18 cm and 7 cm, limit of deviation " + said("%.3f m", limit);
  e.figure.expected = low_is_one ? "all four are obstacles; slower between the two near ones"
                                 : "the boxes of 18 cm are obstacles, those of 7 cm are not";
  e.figure.area = {-0.6, -1.6, 5.2, 3.2};
  return e;
}

/// The same cardboard upright and as a ramp, limit 0.015 m.
Experiment cardboard(const RobotDescription& platform, std::uint64_t seed, bool upright) {
  sim::World world = worldOf("experiment_ramp");
  world.start.y = upright ? 0.65 : -0.65;
  Experiment e;
  e.name = upright ? "cardboard_upright" : "cardboard_ramp";
  e.robot = withOriginalMethod(platform, 0.015);
  e.record = driveStraight(world, e.robot, seed, {0.3, 0.0, 0.0}, 14.0, 0.1,
                           [](const DriveSample& s, const DriveStep&) { return s.pose.x > 1.9; });
  const double x = e.record.samples.back().pose.x;
  if (upright) {
    judgeBox(e, world, "upright_box", "cardboard upright", true);
    const double left = 2.15 - 0.25 - x;  // from the robot's front to the box
    e.findings.push_back({"stands before it", "0.25 m, up to 0.2 m more", said("%.2f m", left),
                          left >= 0.23 && left <= 0.45});
  } else {
    const CellCount cells = countCells(e.record.moment, outlineOf(world, "ramp", kInsideIt));
    const double share = 100.0 * cells.floor / std::max(1, cells.known);
    e.findings.push_back({"cardboard as a ramp", "floor", said("%.0f %% of its cells floor", share),
                          cells.known >= 20 && share >= 98.0});
    e.findings.push_back({"drives up it", "past 1.9 m", said("%.2f m", x), x > 1.9});
  }
  judgeContacts(e);
  e.figure.title = std::string("Cardboard ") + (upright ? "upright" : "as a ramp") +
                   ", limit of deviation 0.015 m";
  e.figure.expected =
      upright ? "an obstacle: the robot stands 0.25 m before it" : "floor: the robot drives up it";
  e.figure.area = {-0.6, -1.6, 5.2, 3.2};
  return e;
}

/// The corridor with the wheels at 0 and at 45 degrees.
Experiment corridor(const RobotDescription& platform, std::uint64_t seed, bool diagonal) {
  const sim::World world = worldOf("experiment_corridor");
  Experiment e;
  e.name = diagonal ? "corridor_45" : "corridor_0";
  e.robot = platform;
  const Twist2 twist = diagonal ? Twist2{0.2, 0.2, 0.0} : Twist2{0.3, 0.0, 0.0};
  e.record = driveStraight(world, e.robot, seed, twist, 40.0, 0.3, standsAgain());
  const Corridor formula(e.robot.outline(), {twist.vx, twist.vy}, e.robot.avoidance.margin);
  const double half = diagonal ? (0.25 + 0.20) * std::sqrt(0.5) : 0.20;
  e.findings.push_back({"half width of the corridor", said("%.3f m", half),
                        said("%.3f m", formula.halfWidth()),
                        std::abs(formula.halfWidth() - half) < 1e-6});
  const auto judge = [&](const char* model, const char* what, const char* expected) {
    const std::string seen =
        nameOf(judgedWithin(e.record.moment, outlineOf(world, model, kAroundIt)));
    e.findings.push_back({what, expected, seen, seen == expected});
  };
  judge("ahead", "box straight ahead", diagonal ? "ignored" : "in the way");
  judge("diagonal", "box at 45 degrees", diagonal ? "in the way" : "beside it");
  judge("aside", "box aside", "ignored");
  judge("behind", "box behind, by ultrasound", "ignored");
  e.findings.push_back({"stands before the box", "yes",
                        e.record.samples.back().measured < 0.005 ? "yes" : "no",
                        e.record.samples.back().measured < 0.005});
  judgeContacts(e);
  e.figure.title =
      std::string("Corridor with the wheels at ") + (diagonal ? "45" : "0") + " degrees";
  e.figure.expected = diagonal ? "half width 0.318 m; only the box at 45 degrees is in the way"
                               : "half width 0.200 m; only the box ahead is in the way";
  e.figure.area = {-1.6, -1.6, 5.2, 3.2};
  e.figure.look_ahead = diagonal ? 1.2 : 2.2;
  return e;
}

/// Drives a route of the world to its end.
DriveRecord driveRoute(const sim::World& world, const std::string& route,
                       const RobotDescription& robot, std::uint64_t seed, double seconds,
                       const DriveRecorder::Condition& worth) {
  DriveLoop loop(world, robot, parametersOf(seed));
  DriveRecorder recorder(loop);
  recorder.record().route = world.routes.at(route);
  loop.drive(recorder.record().route, std::nullopt, false);
  int standing = 0;
  recorder.run(
      seconds,
      [&](const DriveSample& s, const DriveStep& step) {
        const bool ended = step.executor.state == ExecutorState::kReached && s.measured < 0.005;
        standing = ended ? standing + 1 : 0;
        return standing > 25;
      },
      worth);
  return recorder.record();
}

void judgeReached(Experiment& e) {
  const double off = (e.record.samples.back().pose.position() - e.record.route.back()).norm();
  e.findings.push_back(
      {"end of the route", "reached within 3 cm",
       e.record.reached ? said("reached, %.1f cm off", 100.0 * off) : "not reached",
       e.record.reached && off <= 0.03});
}

/// How often the speed fell below `low` after it had been above `high`.
int dips(const DriveRecord& record, double low, double high) {
  int count = 0;
  bool above = false;
  for (const auto& s : record.samples) {
    if (s.measured > high) above = true;
    if (above && s.measured < low) {
      ++count;
      above = false;
    }
  }
  return count;
}

/// Largest change of the measured speed within 0.1 s [m/s^2].
double harshest(const DriveRecord& record) {
  double most = 0.0;
  for (std::size_t i = 5; i < record.samples.size(); ++i) {
    const auto& a = record.samples[i - 5];
    const auto& b = record.samples[i];
    most = std::max(most, std::abs(b.measured - a.measured) / (b.time - a.time));
  }
  return most;
}

/// Somebody crosses a straight route at 40 cm/s.
Experiment crossing(const RobotDescription& platform, std::uint64_t seed) {
  sim::World world = worldOf("experiment_crossing");
  // The robot sets out slowly, since it has not seen the floor before its feet: whoever crosses
  // waits for that, so that they meet.
  for (auto& model : world.models) {
    if (!model.path) continue;
    for (auto& point : model.path->points) point.time += kLater;
  }
  Experiment e;
  e.name = "crossing";
  e.robot = platform;
  e.record = driveRoute(world, "straight", e.robot, seed, 60.0,
                        [](const DriveSample& s, const DriveStep&) {
                          return s.cause == LimitCause::kObstacle && s.obstacle_distance < 0.75;
                        });
  double least = 1.0, when = 0.0;
  for (const auto& s : e.record.samples) {
    if (s.pose.x < 1.0 || s.pose.x > 5.0 || s.measured >= least) continue;
    least = s.measured;
    when = s.time;
  }
  const double cruise = e.record.fastest(0.0, when), after = e.record.fastest(when, 1e9);
  e.findings.push_back({"speed falls", "below half of " + said("%.2f m/s", cruise),
                        said("to %.2f m/s", least), least < 0.5 * cruise});
  const int fell = dips(e.record, 0.6 * cruise, 0.85 * cruise);
  // The last one is the stop at the end.
  e.findings.push_back({"smoothly", "one fall, then the stop at the end",
                        std::to_string(fell) + " falls", fell == 2});
  const double harsh = harshest(e.record);
  e.findings.push_back({"no harder than the base brakes",
                        said("%.1f m/s^2", e.robot.drive.deceleration), said("%.2f m/s^2", harsh),
                        harsh <= 1.05 * e.robot.drive.deceleration});
  e.findings.push_back(
      {"then recovers", "above 90 %", said("%.2f m/s", after), after >= 0.9 * cruise});
  judgeReached(e);
  judgeContacts(e);
  e.figure.title = "Somebody crosses a straight route at 40 cm/s";
  e.figure.expected = "the speed falls smoothly, then recovers";
  e.figure.area = {-0.5, -2.2, 7.0, 4.3};
  return e;
}

/// Between obstacles that do not move, to a wall.
Experiment betweenObstacles(const RobotDescription& platform, std::uint64_t seed) {
  const sim::World world = worldOf("experiment_route");
  Experiment e;
  e.name = "between_obstacles";
  e.robot = platform;
  e.robot.avoidance.beside_speed = 0.10;
  e.robot.avoidance.margin = 0.25;  // the boxes stand 0.2 m beside the robot
  e.record = driveRoute(world, "slalom", e.robot, seed, 180.0,
                        [](const DriveSample& s, const DriveStep&) { return s.pose.x > 3.3; });
  const auto slowest = [&](double from, double to) {
    double least = 1.0;
    for (const auto& s : e.record.samples) {
      if (s.pose.x >= from && s.pose.x <= to) least = std::min(least, s.measured);
    }
    return least;
  };
  for (const auto& [what, from, to] :
       {std::tuple{"beside the first box", 0.9, 1.9}, {"between the next two", 3.5, 4.8}}) {
    const double speed = slowest(from, to);
    e.findings.push_back(
        {what, "slows to 0.10 m/s", said("%.2f m/s", speed), speed >= 0.07 && speed <= 0.13});
  }
  double least_limit = 1.0;
  for (const auto& s : e.record.samples) {
    if (s.pose.x > 7.0) least_limit = std::min(least_limit, s.limit);
  }
  e.findings.push_back({"at the wall", "almost stops: limit below 0.10 m/s",
                        said("limit %.2f m/s", least_limit), least_limit < 0.10});
  double worst = 0.0;
  for (const auto& point : e.record.route) {
    double nearest = 1e9;
    for (const auto& s : e.record.samples) {
      nearest = std::min(nearest, (s.pose.position() - point).norm());
    }
    worst = std::max(worst, nearest);
  }
  e.findings.push_back(
      {"every waypoint passed", "within 0.10 m", said("%.2f m", worst), worst <= 0.10});
  judgeReached(e);
  judgeContacts(e);
  e.figure.title = "A route of waypoints between obstacles, to a wall";
  e.figure.expected = "10 cm/s beside the obstacles, almost a stop at the wall, the end is reached";
  e.figure.area = {-0.6, -2.1, 9.0, 4.6};
  e.figure.look_ahead = 1.5;
  return e;
}

void conclude(Experiment& experiment) {
  experiment.figure.pass = experiment.pass();
  for (const auto& finding : experiment.findings) {
    experiment.figure.seen +=
        (experiment.figure.seen.empty() ? "" : "; ") + finding.what + ": " + finding.seen;
  }
}

}  // namespace

bool Experiment::pass() const {
  return std::all_of(findings.begin(), findings.end(), [](const auto& f) { return f.pass; });
}

std::vector<Experiment> runOriginalExperiments(const RobotDescription& platform,
                                               std::uint64_t seed) {
  std::vector<Experiment> all;
  all.push_back(boxes(platform, seed, 0.008, "boxes_0008"));
  all.push_back(boxes(platform, seed, 0.036, "boxes_0036"));
  all.push_back(cardboard(platform, seed, true));
  all.push_back(cardboard(platform, seed, false));
  all.push_back(corridor(platform, seed, false));
  all.push_back(corridor(platform, seed, true));
  all.push_back(crossing(platform, seed));
  all.push_back(betweenObstacles(platform, seed));
  for (auto& experiment : all) conclude(experiment);
  return all;
}

}  // namespace pilothouse::bench
