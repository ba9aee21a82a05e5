/// The experiments of the original on the simulated platform: a table of what was expected and
/// seen, and a picture each. docs/evaluation.md tells of each.

#include <cstdio>
#include <iostream>
#include <opencv2/imgcodecs.hpp>

#include "bench/eval_options.hpp"
#include "bench/json_line.hpp"
#include "bench/original_experiments.hpp"
#include "doors/package_files.hpp"

namespace pilothouse::bench {
namespace {

const EvalCommand kCommand{"eval original",
                           "Repeats the original's experiments on the simulated platform, with its "
                           "numbers. Prints a table\n"
                           "on the standard error, a JSON object a finding and a summary; into "
                           "--out a picture each: depth,\n"
                           "map, and the speed with what limited it.",
                           {"--seed", "--out"}};

void print(const Experiment& experiment, const Finding& finding) {
  JsonLine json;
  json.text("eval", "original").text("experiment", experiment.name).text("what", finding.what);
  json.text("expected", finding.expected).text("seen", finding.seen).truth("pass", finding.pass);
  std::cout << json.str() << "\n";
  std::fprintf(stderr, "%-18s %-32s %-38s %-40s %s\n", experiment.name.c_str(),
               finding.what.c_str(), finding.expected.c_str(), finding.seen.c_str(),
               finding.pass ? "pass" : "MISSED");
}

int run(const EvalOptions& options) {
  const auto robot = readRobotFile(packageFile("config/robots/platform.yaml"));
  if (!robot) throw std::runtime_error(robot.reason());
  std::fprintf(stderr, "%-18s %-32s %-38s %-40s\n", "experiment", "what", "expected", "seen");
  int findings = 0, missed = 0, experiments = 0;
  for (const auto& experiment : runOriginalExperiments(*robot, options.seed)) {
    ++experiments;
    for (const auto& finding : experiment.findings) {
      ++findings;
      if (!finding.pass) ++missed;
      print(experiment, finding);
    }
    if (options.out.empty()) continue;
    const std::string path = options.out + "/original_" + experiment.name + ".png";
    if (!cv::imwrite(path, drawDrive(experiment.record, experiment.robot, experiment.figure))) {
      throw std::runtime_error("cannot write " + path);
    }
  }
  JsonLine summary;
  summary.text("eval", "original").truth("summary", true).truth("pass", missed == 0);
  summary.whole("experiments", experiments).whole("findings", findings).whole("missed", missed);
  std::cout << summary.str() << std::endl;
  return missed == 0 ? 0 : 1;
}

}  // namespace
}  // namespace pilothouse::bench

int main(int argc, char** argv) {
  using namespace pilothouse::bench;
  return runEval(kCommand, argc, argv, run);
}
