#include "bench/goal_errand.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "bench/shortest_way.hpp"
#include "bench/world_map.hpp"
#include "sim/random.hpp"

namespace pilothouse::bench {
namespace {

constexpr double kUnknownShare = 0.3;  // of boxes and cylinders that the map lacks
constexpr double kLeast = 1.5;         // from the start to the goal [m]
constexpr double kSpare = 0.05;        // a goal counts as reachable with so much more clearance [m]
constexpr int kGoals = 200;            // places tried

bool startsWith(const std::string& text, const std::string& start) {
  return text.compare(0, start.size(), start) == 0;
}

bool stands(const sim::Model& model) {
  return !startsWith(model.name, "floor") && !startsWith(model.name, "ramp") &&
         !startsWith(model.name, "sill");
}

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

}  // namespace

sim::RandomWorld worldOf(const GoalTask& task) {
  sim::RandomWorldParameters parameters;
  parameters.robot_radius = task.robot->outline().farthestFrom({0.0, 0.0});
  if (task.still) parameters.most_people = 0;
  if (task.still) parameters.blocked_share = 0.0;
  return sim::randomWorld(task.seed, parameters);
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

}  // namespace pilothouse::bench
