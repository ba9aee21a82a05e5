#include "bench/goal_trial.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <optional>
#include <set>

#include "bench/drive_loop.hpp"
#include "bench/shortest_way.hpp"
#include "bench/world_map.hpp"
#include "core/navigation/goal_navigator.hpp"
#include "sim/random.hpp"
#include "sim/random_world.hpp"

namespace pilothouse::bench {
namespace {

constexpr double kUnknownShare = 0.3;  // of boxes and cylinders that the map lacks
constexpr double kLeast = 1.5;         // from the start to the goal [m]
constexpr double kSpare = 0.05;        // a goal counts as reachable with so much more clearance [m]
constexpr double kMoving = 0.01;       // [m/s]
constexpr double kTrailStep = 0.02;    // [m]
constexpr int kGoals = 200;            // places tried

sim::RandomWorld worldOf(const GoalTask& task) {
  sim::RandomWorldParameters parameters;
  parameters.robot_radius = task.robot->outline().farthestFrom({0.0, 0.0});
  if (task.still) parameters.most_people = 0;
  if (task.still) parameters.blocked_share = 0.0;
  return sim::randomWorld(task.seed, parameters);
}

bool startsWith(const std::string& text, const std::string& start) {
  return text.compare(0, start.size(), start) == 0;
}

bool stands(const sim::Model& model) {
  return !startsWith(model.name, "floor") && !startsWith(model.name, "ramp") &&
         !startsWith(model.name, "sill");
}

/// The room as it is, as the robot knows it, and where it shall go.
struct Errand {
  MapCells whole, known;
  Goal goal;
  bool possible = false;
  double shortest = 0.0;
};

/// Whether the robot, and not a smaller one only, gets to places: by two judges, the planner with
/// more to spare than it asks for, and a disc round the whole robot.
class Judge {
 public:
  Judge(const GoalTask& task, const sim::World& world, const MapCells& whole,
        const std::vector<ConvexShape>& shapes)
      : shapes_(shapes),
        start_(world.start),
        planner_(planningOf(kSpare), task.robot->outline(), task.robot->drive.kind),
        disc_(shapes, planner_.check().circumscribed() + planner_.parameters().clearance,
              start_.position()),
        room_(planner_.check().circumscribed() + task.robot->avoidance.stop_distance + kSpare) {
    planner_.setMap(whole);
  }
  bool reachable(const Goal& goal) {
    // Nearer to things than it stops before them the robot is not let, whatever the goal.
    const bool room = std::all_of(shapes_.begin(), shapes_.end(), [&](const ConvexShape& shape) {
      return shape.distanceTo(goal.place) >= room_;
    });
    return room && (disc_.reaches(goal.place) ||
                    planner_.plan(PlanRequest{start_, goal.place, goal.heading}));
  }

 private:
  static PlanningParameters planningOf(double spare) {
    PlanningParameters parameters;
    parameters.clearance += spare;
    return parameters;
  }
  const std::vector<ConvexShape>& shapes_;
  Pose2 start_;
  Planner planner_;
  DiscReach disc_;
  double room_;
};

/// What the map has: not the unexpected box, and only some of the boxes and cylinders.
std::function<bool(const sim::Model&)> knownOf(const GoalTask& task, const sim::World& world,
                                               sim::Random& random) {
  std::set<std::string> known;
  for (const sim::Model& model : world.models) {
    if (model.path || !stands(model)) continue;
    const bool small = startsWith(model.name, "box") || startsWith(model.name, "cylinder");
    const bool unexpected = startsWith(model.name, "unexpected");
    const bool lacks = unexpected || (small && random.chance(kUnknownShare));
    if (task.still || !lacks) known.insert(model.name);
  }
  return [known](const sim::Model& model) { return known.count(model.name) > 0; };
}

std::optional<Errand> errandOf(const GoalTask& task, const sim::World& world) {
  sim::Random random(sim::mixSeed(task.seed, 77));
  Errand errand;
  // It does not drive under what it would see as something in the way.
  const double height = task.robot->floor.clear_height;
  const auto known = knownOf(task, world, random);
  errand.whole = mapOf(world, height, stands);
  errand.known = mapOf(world, height, known);
  const std::vector<ConvexShape> shapes = shapesOf(world, height, stands);
  const double inscribed = FootprintCheck(task.robot->outline(), 0.0).inscribed();
  Judge judge(task, world, errand.whole, shapes);
  const DiscReach core(shapesOf(world, height, known), inscribed - kSpare, world.start.position());
  for (int i = 0; i < kGoals; ++i) {
    const MapCells& map = errand.known;
    const Eigen::Vector2d place(map.centreX(random.integer(0, map.size_x - 1)),
                                map.centreY(random.integer(0, map.size_y - 1)));
    errand.goal = {place, random.uniform(-M_PI, M_PI)};
    if ((world.start.position() - place).norm() < kLeast) continue;
    if (task.unreachable && !core.reaches(place)) return errand;
    if (task.unreachable || !judge.reachable(errand.goal)) continue;
    errand.possible = true;
    errand.shortest = shortestWay(shapes, inscribed + PlanningParameters().clearance,
                                  world.start.position(), place);
    return errand;
  }
  return std::nullopt;
}

ExecutorReport reportOf(const DriveStep& step) {
  ExecutorReport report;
  report.stamp = step.time;
  report.text = step.executor.text;
  const ExecutorReport::State states[] = {ExecutorReport::kIdle, ExecutorReport::kDriving,
                                          ExecutorReport::kWaiting, ExecutorReport::kReached};
  report.state = states[static_cast<std::size_t>(step.executor.state)];
  return report;
}

/// What the sensors see, as the navigator marks it.
std::vector<Planner::Mark> marksOf(const Surroundings& seen, const Pose2& pose) {
  std::vector<Planner::Mark> marks;
  for (const auto& object : seen.objects) {
    if (seen.sources[object.source].name != "camera") continue;
    const MapCell kind = object.kind == CellClass::kDropOff     ? MapCell::kDropOff
                         : object.kind == CellClass::kThreshold ? MapCell::kThreshold
                                                                : MapCell::kOccupied;
    marks.push_back(
        {pose * object.position.cast<double>(), 0.5 * static_cast<double>(object.size), kind});
  }
  return marks;
}

void drive(DriveLoop& loop, const DriveOrder& order) {
  std::vector<Eigen::Vector2d> points;
  for (const Pose2& pose : order.poses) points.push_back(pose.position());
  loop.drive(points, order.heading, false);
}

/// Keeps what a figure shows.
void note(const NavigationStatus& status, const DriveStep& step, double time, GoalRecord& record) {
  static const char* const kPhases[] = {"idle",        "planning", "driving", "waiting", "looking",
                                        "backing off", "pausing",  "reached", "failed"};
  std::string said = kPhases[static_cast<std::size_t>(status.phase)];
  if (!status.text.empty()) said += ": " + status.text;
  if (record.said.empty() || record.said.back().second != said)
    record.said.emplace_back(time, said);
  if (record.trail.empty() ||
      (step.pose.position() - record.trail.back().position()).norm() > kTrailStep) {
    record.trail.push_back(step.pose);
  }
}

}  // namespace

GoalResult runGoal(const GoalTask& task, double max_seconds) {
  const auto began = std::chrono::steady_clock::now();
  GoalResult result;
  result.task = task;
  sim::RandomWorld random = worldOf(task);
  const auto errand = errandOf(task, random.world);
  if (!errand) {
    result.possible = false;
    result.text = "no goal found in this room";
    return result;
  }
  result.possible = errand->possible;
  result.shortest = errand->shortest;
  Planner planner({}, task.robot->outline(), task.robot->drive.kind);
  planner.setMap(errand->known);
  GoalNavigator navigator({}, planner);
  DriveLoopParameters parameters;
  parameters.simulation.sensors.camera = *sim::cameraProfile("kinect_qvga");
  parameters.simulation.sensors.depth_rate = 15.0;
  parameters.simulation.seed = task.seed;
  DriveLoop loop(std::move(random.world), *task.robot, parameters);
  navigator.start(errand->goal);
  const double asked = loop.simulation().time();
  NavigationStatus status;
  DriveStep step;
  double last = asked;
  for (int tick = 0; loop.simulation().time() < max_seconds; ++tick) {
    step = loop.step();
    result.driven += step.twist.linear() * (step.time - last);
    last = step.time;
    if (loop.floor() == nullptr || tick % 2 != 0) continue;  // the camera is still waking up
    planner.mark(marksOf(loop.surroundings(), step.pose));
    NavigationInput input;
    input.now = step.time;
    input.pose = step.pose;
    input.executor = reportOf(step);
    const auto before = std::chrono::steady_clock::now();
    const NavigationOutput output = navigator.step(input);
    const std::chrono::duration<double> thinking = std::chrono::steady_clock::now() - before;
    result.longest_thought = std::max(result.longest_thought, thinking.count());
    note(output.status, step, step.time - asked, result.record);
    status = output.status;
    if (output.order) drive(loop, *output.order);
    if (result.planned == 0.0) result.planned = status.distance_left.value_or(0.0);
    if (navigator.ended()) break;
  }
  result.record.trail.push_back(step.pose);
  result.record.marked = planner.map();
  result.record.whole = errand->whole;
  result.record.known = errand->known;
  result.record.goal = errand->goal;
  result.reached = status.phase == NavigationPhase::kReached;
  result.failed = status.phase == NavigationPhase::kFailed;
  result.text = status.text;
  result.plans = status.plans;
  result.seconds = last - asked;
  result.said_after = result.seconds + result.longest_thought;
  result.off = (step.pose.position() - errand->goal.place).norm();
  result.turned_off = std::abs(wrapped(step.pose.heading - *errand->goal.heading));
  for (const auto& contact : loop.simulation().base().contacts()) {
    ++(contact.robot_speed > kMoving ? result.contacts : result.run_into);
    result.touched += loop.simulation().nameOf(contact.model) + " ";
  }
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - began;
  result.wall_seconds = wall.count();
  return result;
}

}  // namespace pilothouse::bench
