/// Sends random robots to random goals in random furnished rooms, some with people and things that
/// the map lacks, and judges by the truth. docs/evaluation.md defines what is counted.

#include <algorithm>
#include <cmath>
#include <iostream>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "bench/campaign.hpp"
#include "bench/eval_options.hpp"
#include "bench/goal_figure.hpp"
#include "bench/goal_trial.hpp"
#include "bench/json_line.hpp"
#include "sim/random.hpp"

namespace pilothouse::bench {
namespace {

const EvalCommand kCommand{
    "eval goals",
    "Sends each of the three bases to random goals with headings in random "
    "furnished rooms, through\n"
    "planner, navigator, executor, camera, floor, memory, limiter and base. "
    "Every third room is as\n"
    "its map has it, with nobody in it, for the lengths; the others have "
    "people who walk and things\n"
    "that the map lacks; every tenth goal is where the robot cannot get to. Prints "
    "a JSON object a run and\n"
    "a summary.",
    {"--runs", "--only", "--seed", "--out"}};

constexpr double kMaxSeconds = 300.0;  // simulated, a run
constexpr double kDegrees = 180.0 / M_PI;

struct Totals {
  int runs = 0, skipped = 0, possible = 0, reached = 0, impossible = 0, told = 0;
  int contacts = 0, run_into = 0, lengths = 0, without_shortest = 0;
  double told_after = 0.0, off = 0.0, turned_off = 0.0, length_sum = 0.0, longest = 0.0;
  double seconds = 0.0, driven = 0.0, wall = 0.0, longest_thought = 0.0;

  void add(const GoalResult& r) {
    ++runs;
    wall += r.wall_seconds;
    contacts += r.contacts;
    run_into += r.run_into;
    driven += r.driven;
    longest_thought = std::max(longest_thought, r.longest_thought);
    if (!r.possible && !r.task.unreachable) {
      ++skipped;
    } else if (r.task.unreachable) {
      ++impossible;
      if (r.failed) ++told;
      told_after = std::max(told_after, r.said_after);
    } else {
      addPossible(r);
    }
  }
  void addPossible(const GoalResult& r) {
    ++possible;
    if (!r.reached) return;
    ++reached;
    seconds += r.seconds;
    off = std::max(off, r.off);
    turned_off = std::max(turned_off, r.turned_off);
    if (!r.task.still) return;
    if (!std::isfinite(r.shortest)) {
      ++without_shortest;
      return;
    }
    ++lengths;
    const double share = (r.driven + r.off) / r.shortest;
    length_sum += share;
    longest = std::max(longest, share);
  }
};

void print(const GoalResult& r) {
  JsonLine json;
  json.text("eval", "goals").whole("run", r.task.run).whole("seed", r.task.seed);
  json.text("robot", r.task.robot->name).truth("still", r.task.still);
  json.truth("possible", r.possible).truth("reached", r.reached).truth("failed", r.failed);
  json.number("seconds", r.seconds, 2).number("driven_m", r.driven, 3);
  json.number("planned_m", r.planned, 3);
  json.number("shortest_m", r.shortest, 3).number("off_m", r.off, 4);
  json.number("turned_off_deg", r.turned_off * kDegrees, 2).whole("plans", r.plans);
  json.whole("contacts", r.contacts).whole("run_into", r.run_into).text("touched", r.touched);
  json.number("longest_thought_s", r.longest_thought, 4);
  json.number("wall_s", r.wall_seconds, 2).text("text", r.text);
  std::cout << json.str() << std::endl;
}

/// Whether somebody should look why.
bool isMissed(const GoalResult& r) {
  const bool came = r.task.unreachable ? r.failed : r.reached;
  return (r.possible || r.task.unreachable) && (!came || r.contacts + r.run_into > 0);
}

void draw(const GoalResult& result, const std::string& folder) {
  const std::string file = folder + "/goal_" + std::to_string(result.task.run) + ".png";
  if (!cv::imwrite(file, drawGoal(result))) throw std::runtime_error("cannot write " + file);
}

int run(const EvalOptions& options) {
  if (options.only && *options.only >= options.runs) {
    throw std::invalid_argument("--only is " + std::to_string(*options.only) +
                                ", expected less than --runs, " + std::to_string(options.runs));
  }
  const auto fleet = campaignRobots();
  std::vector<GoalTask> tasks;
  for (int i = 0; i < options.runs; ++i) {
    GoalTask task;
    task.run = i;
    task.seed = sim::mixSeed(options.seed, static_cast<std::uint64_t>(i));
    task.robot = &fleet[static_cast<std::size_t>(i) % fleet.size()];
    task.still = (i / 3) % 3 == 0;
    task.unreachable = i % 10 == 9;
    if (!options.only || i == *options.only) tasks.push_back(task);
  }
  Totals totals;
  const auto drive = [](const GoalTask& task) { return runGoal(task, kMaxSeconds); };
  runCampaign(tasks, drive, [&](const GoalResult& result) {
    print(result);
    if (!options.out.empty() && (options.only || isMissed(result))) draw(result, options.out);
    totals.add(result);
  });
  // What is not judged must not hide: goals that count as impossible, lengths without an optimum.
  const double still = totals.lengths + totals.without_shortest;
  const std::vector<Bar> bars = {
      {"reached_percent", 100.0 * totals.reached / std::max(1, totals.possible),
       totals.possible > 0 ? 99.5 : 0.0, true},
      {"unreachable_told_percent", 100.0 * totals.told / std::max(1, totals.impossible),
       totals.impossible > 0 ? 100.0 : 0.0, true},
      {"unreachable_told_after_s", totals.told_after, 1.0, false},
      {"contacts", static_cast<double>(totals.contacts + totals.run_into), 0.0, false},
      {"length_over_shortest", totals.length_sum / std::max(1, totals.lengths), 1.05, false},
      {"final_error_m", totals.off, 0.05, false},
      {"final_error_deg", totals.turned_off * kDegrees, 3.0, false},
      {"goals_judged", static_cast<double>(totals.possible), options.only ? 0.0 : 1.0, true},
      {"rooms_without_goal_percent", 100.0 * totals.skipped / std::max(1, totals.runs), 5.0, false},
      {"without_shortest_percent", 100.0 * totals.without_shortest / std::max(1.0, still), 10.0,
       false},
  };
  const bool pass = tellBars(bars);
  JsonLine summary;
  summary.text("eval", "goals").truth("summary", true);
  summary.truth("pass", pass).whole("runs", totals.runs).whole("seed", options.seed);
  for (const Bar& bar : bars) summary.number(bar.name, bar.value, 4);
  summary.whole("possible", totals.possible).whole("rooms_without_goal", totals.skipped);
  summary.whole("contacts_by_robot", totals.contacts).whole("run_into_standing", totals.run_into);
  summary.whole("lengths", totals.lengths).whole("without_shortest", totals.without_shortest);
  summary.number("worst_length_over_shortest", totals.longest, 3);
  summary.number("longest_thought_s", totals.longest_thought, 3);
  summary.number("driven_m", totals.driven, 1);
  summary.number("seconds_a_goal", totals.seconds / std::max(1, totals.reached), 1);
  summary.number("core_seconds_a_run", totals.wall / std::max(1, totals.runs), 2);
  std::cout << summary.str() << std::endl;
  return pass ? 0 : 1;
}

}  // namespace
}  // namespace pilothouse::bench

int main(int argc, char** argv) {
  using namespace pilothouse::bench;
  return runEval(kCommand, argc, argv, run);
}
