// How long the way is judged, the stop gate steps, and where the simulator's time goes. See --help.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "bench/gate_bench.hpp"
#include "bench/limit_table.hpp"
#include "core/motion/local_memory.hpp"
#include "core/motion/speed_limiter.hpp"
#include "doors/package_files.hpp"
#include "nodelets/sim_robot.hpp"
#include "sim/simulation.hpp"
#include "sim/world_file.hpp"

namespace pilothouse::bench {
namespace {

constexpr double kLimiterMs = 0.1;               // corridor and limit of 5,000 objects
constexpr double kGateMs = 0.01;                 // a step of the stop gate
constexpr double kSimulationMs = 1000.0 / 30.0;  // a frame of 640 x 480 with its share of colour
constexpr int kObjects = 5000;

const BenchCommand kCommand{
    "bench_motion",
    "usage: bench_motion [--rounds N] [--out FILE]\n"
    "Times the way's judgement with 5,000 objects, straight, on arcs and turning, for a "
    "rectangular\n"
    "and a round robot, beside stepping the footprint along the way; a step of the stop gate; the\n"
    "memory's frame; and the simulator's frame by its parts (furnished room, 640x480 depth at 30 "
    "Hz,\n"
    "colour at 15 Hz).\n"
    "  --rounds N    5..100000 (default 300)\n"
    "  --out FILE    write a JSON object a line to FILE\n"
    "Limits: 0.1 ms for the way, 0.01 ms for the gate, real time for the simulator. Ends with 1\n"
    "where one is missed, 2 on a wrong call.\n",
    {}};

RobotDescription robot(const std::string& name) {
  const auto description = readRobotFile(packageFile("config/robots/" + name + ".yaml"));
  if (!description) throw std::runtime_error(description.reason());
  return *description;
}

/// A robot among objects, as many as are never seen, and what it wants.
struct Crowd {
  SpeedLimiter limiter;
  Footprint footprint;
  Surroundings surroundings;
  Twist2 twist;

  Crowd(const RobotDescription& robot, const Twist2& wanted)
      : limiter(robot.avoidance, robot.drive, robot.outline()),
        footprint(robot.outline()),
        twist(wanted) {
    sim::Random random(1);
    surroundings.sources.push_back({"camera", 0.0});
    while (surroundings.objects.size() < kObjects) {
      Obstacle object;
      object.position = {static_cast<float>(random.uniform(-1.0, 4.0)),
                         static_cast<float>(random.uniform(-2.5, 2.5))};
      if (footprint.distanceTo(object.position.cast<double>()) < 0.1) continue;
      surroundings.objects.push_back(object);
    }
  }

  double judge() { return limiter.limitAlong(twist, surroundings, nullptr).obstacle_distance; }

  /// The way in steps of a cell, each with every object: what trajectory simulators do.
  double stepAlong() {
    const SweptPath path(footprint, twist, 0.0, 3.0);
    for (double way = 0.0; way <= 3.0; way += 0.05) {
      const Pose2 pose = path.poseAfter(way);
      for (const auto& object : surroundings.objects) {
        if (footprint.distanceTo(pose.toBase(object.position.cast<double>())) < 0.025) return way;
      }
    }
    return std::numeric_limits<double>::infinity();
  }
};

constexpr const char* kGateCase = "stop gate, a step in motion";
constexpr int kGateSteps = 100;  // timed at once

volatile double sink = 0.0;  // what is computed must not be left out

void addWays(std::vector<TimedCase>& cases) {
  const struct {
    const char* name;
    Twist2 twist;
  } ways[] = {{"straight", {0.5, 0.0, 0.0}},
              {"wide arc", {0.5, 0.0, 0.5}},
              {"tight arc", {0.4, 0.0, -1.0}},
              {"turning in place", {0.0, 0.0, 1.0}}};
  for (const std::string name : {"platform", "docker"}) {
    for (const auto& way : ways) {
      const auto crowd = std::make_shared<Crowd>(robot(name), way.twist);
      cases.push_back(
          {name + ", " + way.name, [crowd] { sink = crowd->judge(); }, {}, false, kLimiterMs});
    }
  }
  const auto crowd = std::make_shared<Crowd>(robot("platform"), ways[1].twist);
  crowd->surroundings.objects.erase(
      std::remove_if(crowd->surroundings.objects.begin(), crowd->surroundings.objects.end(),
                     [&](const Obstacle& object) {
                       const SweptPath path(crowd->footprint, crowd->twist, 0.0, 3.0);
                       return path.meet(object.position.cast<double>(), 0.1).relevance ==
                              Relevance::kInTheWay;
                     }),
      crowd->surroundings.objects.end());  // free to its end, the longest for stepping
  cases.push_back({"wide arc, free", [crowd] { sink = crowd->judge(); }, {}, false, kLimiterMs});
  cases.push_back({"wide arc, free, stepped (rival)",
                   [crowd] { sink = crowd->stepAlong(); },
                   {},
                   true,
                   std::nullopt});
}

/// Armed, with a person driving: all that a step can have to do.
void addGate(std::vector<TimedCase>& cases) {
  const auto gate = std::make_shared<GateBench>();
  gate->console = true;
  gate->run(0.2);
  gate->wanted = {};
  gate->source = CommandSource::kTeleop;
  if (!gate->armed()) throw std::runtime_error("the stop gate does not let itself be armed");
  gate->wanted = {0.3, 0.0, 0.1};
  cases.push_back({kGateCase,
                   [gate] {
                     for (int i = 0; i < kGateSteps; ++i) sink = gate->tick().command.vx;
                     if (sink == 0.0) throw std::runtime_error("the stop gate stopped");
                   },
                   {},
                   false,
                   kGateSteps * kGateMs});
}

void addMemory(std::vector<TimedCase>& cases) {
  struct Memory {
    RobotDescription description = robot("platform");
    LocalMemory memory{description.avoidance, description.outline()};
    FloorCells cells;
    std::vector<Obstacle> objects;
    double now = 0.0;
  };
  const auto m = std::make_shared<Memory>();
  auto& g = m->cells.geometry;
  g.x_min = 0.2F;
  g.y_min = -2.5F;
  g.size_x = 76;
  g.size_y = 100;
  m->cells.classes.assign(g.cells(), CellClass::kFloor);
  m->cells.heights.assign(g.cells(), 0.2F);
  for (std::size_t i = 0; i < g.cells(); i += 7) m->cells.classes[i] = CellClass::kObstacle;
  cases.push_back({"memory, a frame and its objects",
                   [m] {
                     m->now += 0.033;
                     const FloorFrame frame{m->now, m->cells.geometry, m->cells.classes.data(),
                                            m->cells.heights.data()};
                     const Pose2 pose{0.5 * m->now, 0.0, 0.1 * m->now};
                     m->memory.add(frame, pose);
                     m->objects.clear();
                     m->memory.collect(pose, m->now, m->objects);
                     sink = static_cast<double>(m->objects.size());
                   },
                   {},
                   false,
                   std::nullopt});
}

void timeSimulator(LimitTable& table, int seconds) {
  const auto world = sim::loadWorld(packageFile("maps/furnished_room.sdf"));
  if (!world) throw std::runtime_error(world.reason());
  sim::Simulation simulation(world->world, simRobotOf(robot("platform")));
  const double frames = 30.0 * seconds;
  const auto began = std::chrono::steady_clock::now();
  while (simulation.time() < seconds) {
    simulation.command({0.0, 0.0, 0.3});
    simulation.step();
  }
  const std::chrono::duration<double, std::milli> all = std::chrono::steady_clock::now() - began;
  const auto& times = simulation.times();
  double known = 0.0;
  for (std::size_t part = 0; part < sim::PartTimes::kParts; ++part) {
    const double ms = 1000.0 * times.seconds(static_cast<sim::PartTimes::Part>(part)) / frames;
    known += ms;
    table.tell(std::string("simulator, ") + sim::PartTimes::kNames[part], ms, ms, std::nullopt);
  }
  const double frame = all.count() / frames;
  table.tell("simulator, rest", frame - known, frame - known, std::nullopt);
  table.tell("simulator, a frame", frame, frame, kSimulationMs);
}

void run(const BenchOptions& options, LimitTable& table) {
  std::vector<TimedCase> cases;
  addWays(cases);
  addGate(cases);
  addMemory(cases);
  table.measure(cases);
  for (const auto& c : cases) {
    const double share = c.name == kGateCase ? 1.0 / kGateSteps : 1.0;
    std::optional<double> limit;
    if (c.limit) limit = *c.limit * share;
    table.tell(c.name, share * quantile(c.times_ms, 0.5), share * quantile(c.times_ms, 0.95),
               limit);
  }
  timeSimulator(table, std::max(2, options.rounds / 30));
}

}  // namespace
}  // namespace pilothouse::bench

int main(int argc, char** argv) {
  using namespace pilothouse::bench;
  return runBench(kCommand, argc, argv, 5, run);
}
