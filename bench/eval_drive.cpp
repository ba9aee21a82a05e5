/// Drives random robots through random worlds with people, and judges every step by the truth.
/// docs/evaluation.md defines what is counted.

#include <algorithm>
#include <cmath>
#include <iostream>

#include "bench/campaign.hpp"
#include "bench/drive_trial.hpp"
#include "bench/eval_options.hpp"
#include "bench/json_line.hpp"
#include "sim/random.hpp"

namespace pilothouse::bench {
namespace {

const EvalCommand kCommand{
    "eval drive",
    "Drives each of the three bases along routes in random worlds, with people who cross, noise "
    "and\n"
    "slip, through the whole chain: simulated camera and rangers, floor, memory, limiter, base.\n"
    "Prints a JSON object a run and a summary.",
    {"--runs", "--seed"}};

constexpr double kMaxSeconds = 240.0;  // simulated, a run

struct Totals {
  int runs = 0, blocked = 0, blocked_held = 0, contacts = 0, run_into = 0;
  int free = 0, reached = 0;
  double wanting = 0.0, false_stop = 0.0, worst_past = 0.0, driven = 0.0;
  double seconds = 0.0, free_seconds = 0.0, wall = 0.0;

  void add(const DriveResult& r) {
    ++runs;
    contacts += r.contacts;
    run_into += r.run_into;
    wanting += r.wanting;
    false_stop += r.false_stop;
    worst_past = std::max(worst_past, r.too_near);
    driven += r.driven;
    wall += r.wall_seconds;
    if (r.blocked) {
      ++blocked;
      if (!r.reached) ++blocked_held;
      return;
    }
    ++free;
    if (!r.reached) return;
    ++reached;
    seconds += r.seconds;
    free_seconds += r.free_seconds;
  }
};

void print(const DriveResult& r) {
  JsonLine json;
  json.text("eval", "drive").whole("run", r.task.run).whole("seed", r.task.seed);
  json.text("robot", r.task.robot->name).text("base", r.task.robot->base);
  json.truth("blocked", r.blocked).truth("reached", r.reached);
  json.number("seconds", r.seconds, 2).number("free_seconds", r.free_seconds, 2);
  json.number("driven_m", r.driven, 2).number("wanting_s", r.wanting, 2);
  json.number("false_stop_s", r.false_stop, 2);
  json.whole("contacts", r.contacts).whole("run_into", r.run_into).text("touched", r.touched);
  json.number("past_stop_distance_m", r.too_near, 4).number("past_at_s", r.too_near_time, 2);
  json.text("past_by", r.too_near_to).number("wall_s", r.wall_seconds, 2);
  if (!r.reached) json.text("why", r.last_text);
  std::cout << json.str() << std::endl;
}

int run(const EvalOptions& options) {
  const auto fleet = campaignRobots();
  std::vector<DriveTask> tasks;
  for (int i = 0; i < options.runs; ++i) {
    const auto& robot = fleet[static_cast<std::size_t>(i) % fleet.size()];
    tasks.push_back({i, sim::mixSeed(options.seed, static_cast<std::uint64_t>(i)), &robot});
  }
  Totals totals;
  const auto drive = [](const DriveTask& task) { return runDrive(task, kMaxSeconds); };
  runCampaign(tasks, drive, [&](const DriveResult& result) {
    print(result);
    totals.add(result);
  });
  const double false_stops = 100.0 * totals.false_stop / std::max(1e-9, totals.wanting);
  const double reached = 100.0 * totals.reached / std::max(1, totals.free);
  const std::vector<Bar> bars = {
      {"contacts", static_cast<double>(totals.contacts + totals.run_into), 0.0, false},
      {"past_stop_distance_m", totals.worst_past, 0.02, false},
      {"false_stop_percent", false_stops, 1.0, false},
      {"reached_percent", reached, 99.0, true},
      {"blocked_held_percent", 100.0 * totals.blocked_held / std::max(1, totals.blocked),
       totals.blocked > 0 ? 100.0 : 0.0, true},
  };
  const bool pass = tellBars(bars);
  JsonLine summary;
  summary.text("eval", "drive").truth("summary", true);
  summary.truth("pass", pass).whole("runs", totals.runs).whole("seed", options.seed);
  for (const Bar& bar : bars) summary.number(bar.name, bar.value, 4);
  summary.whole("contacts_by_robot", totals.contacts).whole("run_into_standing", totals.run_into);
  summary.whole("routes_free", totals.free).whole("routes_blocked", totals.blocked);
  summary.number("driven_m", totals.driven, 1).number("wanting_s", totals.wanting, 1);
  summary.number("time_lost_percent",
                 100.0 * (totals.seconds / std::max(1e-9, totals.free_seconds) - 1.0), 1);
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
