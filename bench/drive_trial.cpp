#include "bench/drive_trial.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>

#include "bench/drive_loop.hpp"
#include "core/motion/power_limit.hpp"
#include "nodelets/sim_robot.hpp"
#include "sim/random_world.hpp"
#include "sim/surroundings.hpp"

namespace pilothouse::bench {
namespace {

constexpr double kTolerance = 0.02;       // past the stop distance, in any direction [m]
constexpr double kMoving = 0.01;          // [m/s]
constexpr double kWanting = 0.02;         // [m/s]
constexpr double kReasonable = 0.15;      // a stop so far before the stop distance is right [m]
constexpr double kBeside = 0.05;          // things so near beside the way are reason enough [m]
constexpr double kStuckSeconds = 60.0;    // without getting on for so long it has given up [s]
constexpr double kBlockedSeconds = 40.0;  // a blocked route is watched for so long [s]

Footprint grown(const Footprint& footprint, double by) {
  std::vector<Eigen::Vector2d> corners;
  const auto& edges = footprint.edges();
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto& a = edges[(i + edges.size() - 1) % edges.size()].normal;
    const auto& b = edges[i].normal;
    corners.push_back(edges[i].from + by / (1.0 + a.dot(b)) * (a + b));
  }
  return Footprint(corners);
}

DriveLoopParameters parametersOf(const DriveTask& task) {
  DriveLoopParameters parameters;
  auto& sensors = parameters.simulation.sensors;
  sensors.camera = *sim::cameraProfile("kinect_qvga");
  sensors.depth_rate = 15.0;
  parameters.simulation.seed = task.seed;
  return parameters;
}

sim::RandomWorld worldOf(const DriveTask& task) {
  sim::RandomWorldParameters parameters;
  parameters.robot_radius = task.robot->outline().farthestFrom({0.0, 0.0});
  return sim::randomWorld(task.seed, parameters);
}

/// Judges every step by the truth.
class Judge {
 public:
  Judge(DriveLoop& loop, const RobotDescription& robot)
      : loop_(loop),
        sim_robot_(simRobotOf(robot)),
        avoidance_(robot.avoidance),
        shrunk_(grown(robot.outline(), -kTolerance)),
        grown_(grown(robot.outline(), kBeside)) {}

  void look(const DriveStep& step, double dt, DriveResult& result) {
    if (loop_.floor() == nullptr) return;  // the camera is still waking up
    const LimitedCommand& limited = step.limited;
    const double reach = avoidance_.stop_distance + kReasonable + 0.3;
    around_.collect(loop_.simulation().scene(), sim_robot_,
                    loop_.simulation().base().T_world_base(), reach);
    const bool wanting = limited.wanted > kWanting;
    if (wanting) result.wanting += dt;
    if (wanting && limited.limit.speed <= 0.0 && nothingInTheWay(step)) result.false_stop += dt;
    notePast(step, result);
  }

 private:
  /// How far before things the robot stops when it moves like this; turning in place needs less.
  double stopDistance(const Twist2& twist, double speed) const {
    const double travel = std::min(1.0, 2.0 * twist.linear() / speed);
    return avoidance_.turn_clearance +
           travel * (avoidance_.stop_distance - avoidance_.turn_clearance);
  }

  bool nothingInTheWay(const DriveStep& step) const {
    const double speed = loop_.limiter().pathSpeed(step.wanted);
    const double enough = stopDistance(step.wanted, speed) + kReasonable;
    return around_.along(grown_, step.wanted, enough).distance >= enough;
  }

  // The outline shrunk by the tolerance: what touches it is past the tolerance in some direction.
  void notePast(const DriveStep& step, DriveResult& result) const {
    const double speed = loop_.limiter().pathSpeed(step.twist);
    if (speed < kMoving) return;
    const double stop = stopDistance(step.twist, speed);
    const sim::FreeWay way = around_.along(shrunk_, step.twist, stop + 0.1);
    const auto& models = loop_.simulation().world().models;
    // Somebody may step in front of the robot: then only contacts count.
    if (way.model < models.size() && models[way.model].path) return;
    // The shrunk outline has that much farther to go.
    const double past = stop - way.distance + kTolerance;
    if (past <= result.too_near) return;
    result.too_near = past;
    result.too_near_time = step.time;
    result.too_near_to = way.model < models.size() ? models[way.model].name : "drop";
  }

  DriveLoop& loop_;
  sim::SimRobot sim_robot_;
  AvoidanceParameters avoidance_;
  Footprint shrunk_, grown_;
  sim::Surroundings around_;
};

void countContacts(DriveLoop& loop, DriveResult& result) {
  std::set<std::string> names;
  for (const auto& contact : loop.simulation().base().contacts()) {
    ++(contact.robot_speed > kMoving ? result.contacts : result.run_into);
    names.insert(loop.simulation().nameOf(contact.model));
  }
  for (const auto& name : names) result.touched += (result.touched.empty() ? "" : " ") + name;
}

double freeSeconds(const DriveTask& task, const sim::World& world,
                   const std::vector<Eigen::Vector2d>& route, double max_seconds) {
  sim::World empty = world;
  for (auto& model : empty.models) {
    if (model.path) model.path->points = {{0.0, {100.0, 100.0, 0.0}}};
  }
  DriveLoopParameters parameters = parametersOf(task);
  parameters.limited = false;
  DriveLoop loop(std::move(empty), *task.robot, parameters);
  loop.drive(route, std::nullopt, false);
  while (loop.simulation().time() < max_seconds) {
    const DriveStep& step = loop.step();
    if (step.executor.state == ExecutorState::kReached) return step.time;
  }
  return 0.0;
}

}  // namespace

DriveResult runDrive(const DriveTask& task, double max_seconds) {
  const auto began = std::chrono::steady_clock::now();
  DriveResult result;
  result.task = task;
  sim::RandomWorld random = worldOf(task);
  result.blocked = random.blocked;
  const auto route = random.world.routes.at("route");
  if (!random.blocked) {
    result.free_seconds = freeSeconds(task, random.world, route, max_seconds);
  }

  DriveLoop loop(std::move(random.world), *task.robot, parametersOf(task));
  Judge judge(loop, *task.robot);
  loop.drive(route, std::nullopt, false);
  const double until = random.blocked ? std::min(kBlockedSeconds, max_seconds) : max_seconds;
  double last = 0.0, got_on = 0.0, left = HUGE_VAL;
  while (loop.simulation().time() < until && !result.reached &&
         loop.simulation().time() - got_on < kStuckSeconds) {
    const DriveStep& step = loop.step();
    judge.look(step, step.time - last, result);
    result.driven += step.twist.linear() * (step.time - last);
    last = step.time;
    result.reached = step.executor.state == ExecutorState::kReached;
    result.last_text = step.executor.text;
    if (step.executor.distance_left < left - 0.05) {
      left = step.executor.distance_left;
      got_on = step.time;
    }
  }
  result.seconds = last;
  countContacts(loop, result);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - began;
  result.wall_seconds = wall.count();
  return result;
}

}  // namespace pilothouse::bench
