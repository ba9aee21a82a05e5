/// Judges the floor methods on random scenes whose truth is known. docs/evaluation.md defines what
/// is counted.

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <iostream>
#include <thread>

#include "bench/eval_options.hpp"
#include "bench/floor_bars.hpp"
#include "bench/floor_figures.hpp"
#include "bench/floor_trial.hpp"
#include "bench/json_line.hpp"

namespace pilothouse::bench {
namespace {

const EvalCommand kCommand{
    "eval floor",
    "Renders random scenes as a noisy depth camera sees them and compares the floor methods with\n"
    "the truth: once with the mounting as configured, once with it off by up to 3 degrees and 2 "
    "cm\n"
    "and calibration on. Prints a JSON object a scene and a summary; a table goes to stderr.",
    {"--runs", "--seed", "--out"}};

struct Figure {
  const char* name;
  Share FloorScore::*share;
};
constexpr Figure kFigures[] = {
    {"iou", &FloorScore::iou},
    {"precision", &FloorScore::precision},
    {"recall_7cm", &FloorScore::recall_7cm},
    {"recall_18cm", &FloorScore::recall_18cm},
    {"recall", &FloorScore::recall},
    {"ramp_drivable", &FloorScore::ramp_drivable},
    {"sill_drivable", &FloorScore::sill_drivable},
    {"floor_drivable", &FloorScore::floor_drivable},
    {"false_on_empty", &FloorScore::false_on_empty},
    {"beyond_blocked", &FloorScore::beyond_blocked},
    {"measured", &FloorScore::measured},
    {"recall_7cm_strict", &FloorScore::recall_7cm_strict},
    {"recall_18cm_strict", &FloorScore::recall_18cm_strict},
    {"ramp_strict", &FloorScore::ramp_strict},
    {"sill_strict", &FloorScore::sill_strict},
};

/// @param all also the figures that nothing was counted for, as null.
JsonLine jsonOf(const FloorScore& score, bool all) {
  JsonLine json;
  for (const Figure& figure : kFigures) {
    const Share& share = score.*(figure.share);
    if (all || share.isKnown()) json.number(figure.name, percentOf(share), 4);
  }
  return json;
}

const char* nameOfPass(bool calibrating) {
  return calibrating ? "mount_error" : "as_configured";
}

void printScene(const FloorResult& result) {
  JsonLine json;
  json.text("eval", "floor").whole("run", result.task.run).text("scene", nameOf(result.task.kind));
  json.text("mounting", nameOfPass(result.task.calibrating));
  json.object("ceiling", jsonOf(result.ceiling, false));
  json.object("original", jsonOf(result.original, false));
  json.object("improved", jsonOf(result.improved, false));
  if (result.mounting) {
    json.number("mounting_error_deg", result.mounting->angle_deg);
    json.number("mounting_error_mm", result.mounting->height * 1000.0);
  }
  std::cout << json.str() << "\n";
}

void printTable(const char* title, const FloorTotals& totals, const std::vector<Bar>& bars) {
  std::fprintf(stderr, "\n%-20s %10s %10s %10s   %s\n", title, "ceiling", "original", "improved",
               "bar");
  for (const Figure& figure : kFigures) {
    std::fprintf(stderr, "%-20s %10.3f %10.3f %10.3f", figure.name,
                 percentOf(totals.ceiling.*(figure.share)),
                 percentOf(totals.original.*(figure.share)),
                 percentOf(totals.improved.*(figure.share)));
    for (const Bar& bar : bars) {
      if (bar.name != figure.name) continue;
      std::fprintf(stderr, "   %s %.3f %s", bar.at_least ? ">=" : "<=", bar.limit,
                   bar.isMet() ? "met" : "MISSED");
    }
    std::fprintf(stderr, "\n");
  }
}

JsonLine jsonOf(const FloorTotals& totals, const std::vector<Bar>& bars, bool calibrating) {
  JsonLine json;
  json.object("ceiling", jsonOf(totals.ceiling, true));
  json.object("original", jsonOf(totals.original, true));
  json.object("improved", jsonOf(totals.improved, true));
  if (calibrating) {
    json.whole("mountings", totals.calibrations)
        .whole("mountings_found", totals.calibrations_found);
    json.number("mountings_in_limits", percentOf(totals.mountings_in_limits));
    json.number("worst_mounting_error_deg", totals.worst_angle_deg);
    json.number("worst_mounting_error_mm", totals.worst_height * 1000.0);
  } else {
    json.number("doors_agree", percentOf(totals.doors_agree), 4);
  }
  JsonLine missed;
  for (const Bar& bar : bars) {
    if (!bar.isMet()) missed.number(bar.name, bar.limit);
  }
  json.object("missed", missed);
  return json;
}

/// Judges all tasks on two threads; the order of the results does not depend on them.
std::vector<FloorResult> judge(const std::vector<FloorTask>& tasks, const EvalOptions& options) {
  std::vector<FloorResult> results(tasks.size());
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < tasks.size(); i = next++) {
      results[i] = runTrial(tasks[i], options.seed, false);
    }
  };
  std::thread other(work);
  work();
  other.join();
  return results;
}

/// Cells that the improved method has wrong.
std::uint64_t faultsOf(const FloorScore& s) {
  const auto rest = [](const Share& share) { return share.whole - share.part; };
  return rest(s.iou) + rest(s.ramp_drivable) + rest(s.sill_drivable) + rest(s.floor_drivable) +
         rest(s.beyond_blocked);
}

/// Draws the first run's scenes and the four that the improved method does worst.
void drawFigures(const std::vector<FloorResult>& results, const EvalOptions& options) {
  std::vector<const FloorResult*> worst;
  for (const FloorResult& result : results) worst.push_back(&result);
  std::stable_sort(worst.begin(), worst.end(), [](const FloorResult* a, const FloorResult* b) {
    return faultsOf(a->improved) > faultsOf(b->improved);
  });
  const auto draw = [&](const FloorTask& task, const std::string& prefix) {
    const std::string file = options.out + "/" + prefix + nameOf(task.kind) +
                             (task.calibrating ? "_mount_error" : "") + ".png";
    drawTrial(runTrial(task, options.seed, true), file);
    std::cerr << "drew " << file << "\n";
  };
  for (const FloorResult& result : results) {
    if (result.task.run == 0) draw(result.task, "");
  }
  for (std::size_t i = 0; i < std::min<std::size_t>(4, worst.size()); ++i) {
    draw(worst[i]->task,
         "worst_" + std::to_string(i + 1) + "_run" + std::to_string(worst[i]->task.run) + "_");
  }
}

int run(const EvalOptions& options) {
  std::vector<FloorTask> tasks;
  for (const bool calibrating : {false, true}) {
    for (int run = 0; run < options.runs; ++run) {
      for (const sim::SceneKind kind : sim::kSceneKinds) tasks.push_back({run, kind, calibrating});
    }
  }
  const std::vector<FloorResult> results = judge(tasks, options);
  FloorTotals totals[2];
  for (const FloorResult& result : results) {
    printScene(result);
    totals[result.task.calibrating ? 1 : 0].add(result);
  }
  JsonLine summary;
  summary.text("eval", "floor").truth("summary", true);
  bool pass = true;
  JsonLine passes[2];
  for (const bool calibrating : {false, true}) {
    const FloorTotals& t = totals[calibrating ? 1 : 0];
    const std::vector<Bar> bars = barsOf(t, calibrating);
    for (const Bar& bar : bars) pass = pass && bar.isMet();
    printTable(nameOfPass(calibrating), t, bars);
    passes[calibrating ? 1 : 0] = jsonOf(t, bars, calibrating);
  }
  std::fprintf(stderr,
               "mounting found within 0.2 degrees and 5 mm: %.1f %%, worst %.3f degrees, %.2f mm\n",
               percentOf(totals[1].mountings_in_limits), totals[1].worst_angle_deg,
               totals[1].worst_height * 1000.0);
  if (!options.out.empty()) drawFigures(results, options);
  summary.truth("pass", pass).whole("runs", options.runs);
  summary.whole("seed", options.seed);
  for (const bool calibrating : {false, true}) {
    summary.object(nameOfPass(calibrating), passes[calibrating ? 1 : 0]);
  }
  std::cout << summary.str() << std::endl;
  return pass ? 0 : 1;
}

}  // namespace
}  // namespace pilothouse::bench

int main(int argc, char** argv) {
  using namespace pilothouse::bench;
  return runEval(kCommand, argc, argv, run);
}
