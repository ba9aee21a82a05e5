/// Corrects odometry by scans, and judges the corrected track beside the raw one by the truth.
/// docs/pose.md says what is counted.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <opencv2/imgcodecs.hpp>

#include "bench/eval_options.hpp"
#include "bench/floor_bars.hpp"
#include "bench/pose_bag.hpp"
#include "bench/pose_figure.hpp"
#include "bench/pose_judging.hpp"
#ifdef PILOTHOUSE_WITH_SIMULATOR
#include "bench/pose_simulation.hpp"
#include "doors/package_files.hpp"
#include "sim/random.hpp"
#endif

namespace pilothouse::bench {
namespace {

const EvalCommand kCommand{
    "eval pose",
    "Tracks a robot's pose by odometry corrected by scans, and compares the corrected and the raw\n"
    "track with a reference. With --bag: of a recording with LaserScan, odometry (tf or\n"
    "nav_msgs/Odometry) and, to be judged, a topic with ground_truth in its name. Without: of\n"
    "simulated robots that slip, in random worlds, by a laser, by level_scan and by virtual_scan\n"
    "in turn; and of one that drives for three minutes. Prints JSON lines; the last one is the "
    "summary.",
    {"--bag", "--runs", "--seed", "--out"}};

constexpr double kMostError = 0.05;  // [m]
constexpr double kMostShare = 0.5;   // of the raw error
constexpr double kMostLaserShare = 0.12;
constexpr double kMostLevelShare = 0.35;
constexpr double kMostTourError = 0.05, kMostTourMax = 0.1;  // of the furnished room's tour [m]
// Of the way and the turns that the wheels count, without a gyroscope: what a scan corrects must
// never be worse than what they say.
constexpr double kSlips[] = {0.15, 0.3};
constexpr double kMostSlippingShare = 0.25;
// The virtual scan tells cells, and not far: often there is nothing to hold on to.
constexpr double kMostVirtualShare = 0.65;

int report(const std::vector<Bar>& bars, JsonLine& summary) {
  bool pass = true;
  for (const Bar& bar : bars) {
    pass = pass && bar.isMet();
    std::fprintf(stderr, "%-26s %10.4f   %s %g %s\n", bar.name.c_str(), bar.value,
                 bar.at_least ? ">=" : "<=", bar.limit, bar.isMet() ? "met" : "MISSED");
    summary.number(bar.name, bar.value, 4);
  }
  summary.truth("pass", pass);
  std::cout << summary.str() << std::endl;
  return pass ? 0 : 1;
}

void draw(const EvalOptions& options, const PoseRecording& recording, const PoseReplay& tracks,
          const std::string& name) {
  if (options.out.empty()) return;
  const std::string path = options.out + "/pose_" + name + ".png";
  if (!cv::imwrite(path, drawTracks(recording, tracks, name))) {
    refuse(kCommand, "cannot write '" + path + "'");
  }
}

int evaluateBag(const EvalOptions& options) {
  const auto recording = readPoseBag(options.bag);
  if (!recording) refuse(kCommand, recording.reason());
  for (const auto& note : recording->notes) std::cerr << note << "\n";
  const PoseReplay tracks = replay(*recording, {});
  const PoseJudgement judgement = judge(*recording, tracks, false);
  const std::string name = std::filesystem::path(options.bag).stem().string();
  draw(options, *recording, tracks, name);
  JsonLine line;
  line.text("eval", "pose").text("bag", name).text("odometry", recording->odometry);
  line.text("gyroscope", recording->gyro.empty() ? "none" : recording->gyro);
  line.text("reference", recording->reference_name.empty() ? "none" : recording->reference_name);
  describe(judgement, tracks, line);
  std::cout << line.str() << std::endl;
  JsonLine summary;
  summary.text("eval", "pose").truth("summary", true).truth("judged", judgement.judged);
  if (!judgement.judged) {
    std::cerr << "not judged: no reference where the track is\n";
    std::cout << summary.number("pass", std::nan("")).str() << std::endl;
    return 0;
  }
  const auto share = [](const TrackError& corrected, const TrackError& raw) {
    return corrected.rms / raw.rms;
  };
  summary.number("raw_fit_rms_m", judgement.raw_fit.rms, 4);
  summary.number("reference_late_s", -judgement.offset, 3);
  summary.number("reference_noise_m", judgement.noise, 4);
  // For information; no bar hangs on these.
  summary.number("fit_share_without_noise", shareWithoutNoise(judgement), 3);
  summary.number("unshifted_fit_share",
                 share(judgement.corrected_unshifted, judgement.raw_unshifted), 3);
  summary.number("begin_share", share(judgement.corrected_begin, judgement.raw_begin), 3);
  summary.number("raw_begin_rms_m", judgement.raw_begin.rms, 4);
  summary.number("corrected_begin_rms_m", judgement.corrected_begin.rms, 4);
  // No track that is independent of the reference's noise gets below this.
  summary.number("least_possible_share", judgement.noise / judgement.raw_fit.rms, 3);
  return report(
      {{"corrected_fit_rms_m", judgement.corrected_fit.rms, kMostError, false},
       {"fit_share_of_raw", share(judgement.corrected_fit, judgement.raw_fit), kMostShare, false}},
      summary);
}

#ifdef PILOTHOUSE_WITH_SIMULATOR

double medianOf(std::vector<double> values) {
  if (values.empty()) return std::nan("");
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// Of all runs with one kind of scanner.
struct Totals {
  std::vector<double> raw, corrected;  ///< [m]
  int better = 0;
  void add(const PoseJudgement& judgement) {
    raw.push_back(judgement.raw_begin.rms);
    corrected.push_back(judgement.corrected_begin.rms);
    if (judgement.corrected_begin.rms < judgement.raw_begin.rms) ++better;
  }
  double share() const {
    double with = 0.0, without = 0.0;
    for (const double error : corrected) with += error * error;
    for (const double error : raw) without += error * error;
    return std::sqrt(with / std::max(1e-12, without));
  }
};

/// Three minutes round the furnished room with nothing but the depth camera.
std::vector<Bar> evaluateTour(const EvalOptions& options, const RobotDescription& robot) {
  const PoseRecording recording = simulateTour(robot, options.seed, SimulatedScanner::kLevel);
  const PoseReplay tracks = replay(recording, {});
  const PoseJudgement judgement = judge(recording, tracks, true);
  draw(options, recording, tracks, "tour");
  JsonLine line;
  line.text("eval", "pose").text("drive", "tour").text("scanner", recording.scan_names.front());
  describe(judgement, tracks, line);
  std::cout << line.str() << std::endl;
  return {{"tour_corrected_rms_m", judgement.corrected_begin.rms, kMostTourError, false},
          {"tour_corrected_max_m", judgement.corrected_begin.max, kMostTourMax, false}};
}

int evaluateSimulated(const EvalOptions& options) {
  const auto robot = readRobotFile(packageFile("config/robots/platform.yaml"));
  if (!robot) throw std::runtime_error(robot.reason());
  constexpr SimulatedScanner kScanners[] = {SimulatedScanner::kLaser, SimulatedScanner::kLevel,
                                            SimulatedScanner::kVirtual};
  std::array<Totals, 3> totals_of;
  std::array<Totals, 2> slipping_by;
  for (int run = 0; run < options.runs; ++run) {
    const auto seed = sim::mixSeed(options.seed, static_cast<std::uint64_t>(run));
    const auto kind = static_cast<std::size_t>(run % 3);
    const SimulatedScanner scanner = kScanners[kind];
    const PoseRecording recording = simulatePose(*robot, seed, scanner);
    const PoseReplay tracks = replay(recording, {});
    const PoseJudgement judgement = judge(recording, tracks, true);
    draw(options, recording, tracks, "run_" + std::to_string(run));
    JsonLine line;
    line.text("eval", "pose").whole("run", run).whole("seed", seed);
    line.text("scanner", recording.scan_names.front());
    describe(judgement, tracks, line);
    std::cout << line.str() << std::endl;
    totals_of[kind].add(judgement);
    for (std::size_t i = 0; scanner == SimulatedScanner::kLevel && i < slipping_by.size(); ++i) {
      const PoseRecording slipped = slipping(recording, kSlips[i]);
      slipping_by[i].add(judge(slipped, replay(slipped, {}), true));
    }
  }
  std::vector<Bar> bars = evaluateTour(options, *robot);
  JsonLine summary;
  summary.text("eval", "pose").truth("summary", true).whole("runs", options.runs);
  summary.whole("seed", options.seed);
  const auto add = [&](const std::string& name, const Totals& totals, double most) {
    if (totals.raw.empty()) return;
    summary.number(name + "_raw_median_m", medianOf(totals.raw), 4);
    summary.number(name + "_corrected_median_m", medianOf(totals.corrected), 4);
    summary.number(name + "_corrected_worst_m",
                   *std::max_element(totals.corrected.begin(), totals.corrected.end()), 4);
    summary.whole(name + "_better", totals.better).whole(name + "_runs", totals.raw.size());
    bars.push_back({name + "_share_of_raw", totals.share(), most, false});
  };
  add("laser", totals_of[0], kMostLaserShare);
  add("level_scan", totals_of[1], kMostLevelShare);
  add("virtual_scan", totals_of[2], kMostVirtualShare);
  for (std::size_t i = 0; i < slipping_by.size() && !slipping_by[i].raw.empty(); ++i) {
    const std::string name = "level_scan_slip_" + std::to_string(std::lround(100.0 * kSlips[i]));
    add(name, slipping_by[i], kMostSlippingShare);
    const auto worse = slipping_by[i].raw.size() - static_cast<std::size_t>(slipping_by[i].better);
    bars.push_back({name + "_worse_runs", static_cast<double>(worse), 0.0, false});
  }
  return report(bars, summary);
}

#endif

int run(const EvalOptions& options) {
  if (!options.bag.empty()) return evaluateBag(options);
#ifdef PILOTHOUSE_WITH_SIMULATOR
  return evaluateSimulated(options);
#else
  refuse(kCommand, "built without the simulator: give a recording with --bag");
#endif
}

}  // namespace
}  // namespace pilothouse::bench

int main(int argc, char** argv) {
  using namespace pilothouse::bench;
  return runEval(kCommand, argc, argv, run);
}
