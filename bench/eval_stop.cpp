/// Lets the parts of a driving robot of real processes fail, one at a random instant after the
/// other, and measures how soon the base is told to stand. docs/evaluation.md defines what is
/// counted.

#include <signal.h>
#include <sys/wait.h>

#include <algorithm>
#include <iostream>

#include "bench/eval_options.hpp"
#include "bench/stop_report.hpp"

namespace pilothouse::bench {
namespace {

const EvalCommand kCommand{
    "eval stop",
    "Faults of every part of a driving simulated robot, then obstacles that appear before it with\n"
    "a core kept busy. Bars: fault to zero command p99 <= 0.35 s and max <= 0.5 s, nothing moves\n"
    "before re-arming, all up again within 5 s; depth stamp to zero command p99 <= 0.15 s and\n"
    "max <= 0.25 s, moving within 5 s of the obstacle's end.",
    {"--faults", "--appearances", "--seed", "--out"}};

/// Keeps one core busy while it lives, and no longer than this process, however it ends.
class BusyCore {
 public:
  BusyCore()
      : process_(startProcess({"setpriv", "--pdeathsig", "KILL", "taskset", "-c", "0", "sh", "-c",
                               "while :; do :; done"})) {}
  ~BusyCore() {
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
  }
  BusyCore(const BusyCore&) = delete;
  BusyCore& operator=(const BusyCore&) = delete;

 private:
  pid_t process_;
};

std::vector<StopResult> runFaults(StopRig& rig, int count, std::mt19937& random) {
  const std::vector<StopFault> kinds =
      stopFaults(rig.handle(), {&rig.commandSilent(), &rig.limited()});
  std::vector<std::size_t> order;
  std::vector<StopResult> results;
  for (int i = 0; i < count; ++i) {
    if (order.empty()) {  // each kind once, then all anew
      for (std::size_t k = 0; k < kinds.size(); ++k) order.push_back(k);
      std::shuffle(order.begin(), order.end(), random);
    }
    results.push_back(tryFault(rig, kinds[order.back()], random));
    order.pop_back();
    std::cout << jsonOf(results.back(), i + 1) << std::endl;
  }
  return results;
}

std::vector<AppearanceResult> runAppearances(StopRig& rig, int count, std::mt19937& random) {
  if (count == 0) return {};
  const BusyCore busy;
  failSensor("front", "freeze", 0.0);  // the depth picture alone shows the obstacle
  std::vector<AppearanceResult> results;
  for (int i = 0; i < count; ++i) {
    results.push_back(tryAppearance(rig, random));
    std::cout << jsonOf(results.back(), i + 1) << std::endl;
  }
  failSensor("front", "none", 0.0);
  return results;
}

int run(const EvalOptions& options, int argc, char** argv) {
  std::mt19937 random(static_cast<std::mt19937::result_type>(options.seed));
  StopRig rig(argc, argv, options.seed);
  rig.waitUntilUp();
  rig.armAndDrive();
  const std::vector<StopResult> faults = runFaults(rig, options.faults, random);
  const std::vector<AppearanceResult> appearances =
      runAppearances(rig, options.appearances, random);
  for (const std::string& line : jsonByKind(faults)) std::cout << line << "\n";
  if (!options.out.empty()) drawStops(faults, appearances, options.out + "/stop.png");
  const StopSummary summary = summaryOf(faults, appearances, rig.falseStops());
  std::cout << summary.json << std::endl;
  return summary.pass ? 0 : 1;
}

}  // namespace
}  // namespace pilothouse::bench

int main(int argc, char** argv) {
  using namespace pilothouse::bench;
  const EvalOptions options = readOptions(kCommand, argc, argv);
  try {
    return run(options, argc, argv);
  } catch (const std::exception& fault) {
    std::cerr << "eval stop: " << fault.what() << "\n";
    return 1;
  }
}
