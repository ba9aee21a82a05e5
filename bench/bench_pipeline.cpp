// How long a picture takes from the camera's message to the published grid. See --help.

#include <ros/ros.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>

#include "bench/interleaved_timing.hpp"
#include "bench/json_line.hpp"
#include "bench/own_master.hpp"
#include "bench/pipeline_run.hpp"

namespace pilothouse::bench {
namespace {

constexpr double kLimit_ms = 2.0;  // p95 above the core's median, in one manager

constexpr const char* kHelp =
    "usage: bench_pipeline [--seconds N] [--out FILE]\n"
    "Times the way from a camera's message to the published floor grid at 30 Hz: camera, floor\n"
    "nodelet and listener in one process, then the camera in another process (TCPROS); beside the\n"
    "core alone on the same frames. Starts a ROS master of its own.\n"
    "  --seconds N   length of each of the four runs, 2..3600 (default 20)\n"
    "  --out FILE    write a JSON object a line to FILE\n"
    "Ends with 1 where the 95th percentile in one process is more than 2 ms above the core's\n"
    "median, 2 on a wrong call or when nothing could be measured.\n";

struct Options {
  double seconds = 20.0;
  std::string out;
  std::string camera, name_space;  ///< run as the camera's process: depth or cloud16
};

[[noreturn]] void refuse(const std::string& message) {
  std::cerr << "bench_pipeline: " << message << "\n";
  std::exit(2);
}

Options readOptions(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string option = argv[i];
    if (option == "--help" || option == "-h") {
      std::cout << kHelp;
      std::exit(0);
    }
    std::string* text = option == "--out"         ? &options.out
                        : option == "--camera"    ? &options.camera
                        : option == "--namespace" ? &options.name_space
                                                  : nullptr;
    if (text == nullptr && option != "--seconds") refuse("unknown option '" + option + "'");
    if (++i >= argc) refuse(option + " needs a value");
    if (text != nullptr) {
      *text = argv[i];
      continue;
    }
    char* end = nullptr;
    options.seconds = std::strtod(argv[i], &end);
    if (*end != '\0' || !(options.seconds >= 2.0 && options.seconds <= 3600.0)) {
      refuse(std::string("--seconds is '") + argv[i] + "', expected 2..3600");
    }
  }
  return options;
}

/// Prints and writes one run. @return whether it keeps its limit.
bool report(const PipelineRun& run, const std::string& core_name, const std::vector<double>& core,
            std::ofstream& out) {
  const double core_median = quantile(core, 0.5);
  const double median = quantile(run.latencies_ms, 0.5);
  const double p95 = quantile(run.latencies_ms, 0.95);
  const auto grids = static_cast<long long>(run.latencies_ms.size());
  const bool limited = run.name.rfind("manager/", 0) == 0;
  const bool pass = p95 - core_median <= kLimit_ms;
  std::printf("%-16s %9.3f %9.3f %9.3f %9.3f%s %7.1f %% %6lld of %d\n", run.name.c_str(), median,
              p95, core_median, p95 - core_median, limited && !pass ? " MISSED" : "",
              100.0 * run.processor_share, grids, run.frames_sent);
  JsonLine line;
  line.text("bench", "pipeline").text("case", run.name);
  line.number("median_ms", median).number("p95_ms", p95);
  line.number("ratio", median / core_median).text("of", core_name);
  line.number("core_ms", core_median).number("p95_above_core_ms", p95 - core_median);
  line.number("processor_share", run.processor_share);
  line.whole("grids", grids).whole("frames", run.frames_sent);
  if (limited) line.number("limit_ms", kLimit_ms, 1).truth("pass", pass);
  out << line.str() << '\n';
  return !limited || pass;
}

int run(const Options& options, int argc, char** argv) {
  if (!options.camera.empty()) {
    ros::init(argc, argv, "bench_camera", ros::init_options::AnonymousName);
    return runCamera(options.name_space, options.camera == "depth", options.seconds);
  }
  std::ofstream out;
  if (!options.out.empty()) {
    out.open(options.out);
    if (!out) refuse("cannot write " + options.out);
  }
  const OwnMaster master;
  ros::init(argc, argv, "bench_pipeline", ros::init_options::NoRosout);
  master.waitUntilUp();
  ros::start();
  bool pass = true;
  std::printf("%-16s %9s %9s %9s %9s %9s %12s\n", "case", "median ms", "p95 ms", "core ms",
              "p95-core", "processor", "grids");
  for (const bool depth : {true, false}) {
    const std::vector<double> core = measureCore(depth, options.seconds / 2);
    const std::string core_name = depth ? "core/depth" : "core/cloud16";
    JsonLine line;
    line.text("bench", "pipeline").text("case", core_name);
    line.number("median_ms", quantile(core, 0.5)).number("p95_ms", quantile(core, 0.95));
    out << line.number("ratio", 1.0).text("of", core_name).str() << '\n';
    for (const bool same_process : {true, false}) {
      const PipelineRun result = measurePipeline(depth, same_process, options.seconds, argv[0]);
      pass = report(result, core_name, core, out) && pass;
    }
  }
  ros::shutdown();
  return pass ? 0 : 1;
}

}  // namespace
}  // namespace pilothouse::bench

int main(int argc, char** argv) {
  const auto options = pilothouse::bench::readOptions(argc, argv);
  try {
    return pilothouse::bench::run(options, argc, argv);
  } catch (const std::exception& fault) {
    std::cerr << "bench_pipeline: " << fault.what() << "\n";
    return 2;
  }
}
