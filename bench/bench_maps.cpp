// How long a frame takes to enter the maps, and a path over them. See --help.

#include <algorithm>
#include <fstream>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

#include "bench/bench_options.hpp"
#include "bench/interleaved_timing.hpp"
#include "bench/json_line.hpp"
#include "bench/map_cases.hpp"

namespace pilothouse::bench {
namespace {

const BenchCommand kCommand{
    "bench_maps",
    "usage: bench_maps [--rounds N] [--out FILE]\n"
    "Times a frame's way into the occupancy map (floor grid of a 640x480 picture, scan of 640\n"
    "beams, both with clearing) and into the octree at 5 cm, each beside a plain version of the\n"
    "same; and the planner on maps of up to 4000^2 cells beside textbook Dijkstra.\n"
    "  --rounds N    5..100000 (default 300)\n"
    "  --out FILE    write a JSON object a line to FILE\n"
    "Ends with 1 where a stated limit is missed, 2 on a wrong call.\n",
    {}};

/// Prints and writes one line; @return whether the limit [ms] is kept.
bool tell(std::ostream& out, const TimedCase& c) {
  const double median = quantile(c.times_ms, 0.5), p95 = quantile(c.times_ms, 0.95);
  JsonLine line;
  line.text("bench", "maps").text("case", c.name).number("median_ms", median, 4);
  line.number("p95_ms", p95, 4);
  std::printf("%-44s %10.4f %10.4f", c.name.c_str(), median, p95);
  const bool kept = !c.limit || median <= *c.limit;
  if (c.limit) {
    line.number("ratio", median / *c.limit, 3).text("of", "limit").number("limit_ms", *c.limit, 3);
    line.truth("pass", kept);
    std::printf(" %8.3f%s", median / *c.limit, kept ? "" : "  MISSED");
  }
  std::printf("\n");
  out << line.str() << '\n';
  return kept;
}

int run(const BenchOptions& options) {
  std::ofstream out;
  if (!options.out.empty()) {
    out.open(options.out);
    if (!out) refuse(kCommand, "cannot write " + options.out);
  }
  pinToOneProcessor();
  std::vector<TimedCase> cases;
  addOccupancyCases(cases);
  addVolumeCases(cases);
  addPlanningCases(cases);
  measure(cases, options.rounds, std::max(5, options.rounds / 20));
  std::printf("%-44s %10s %10s %8s\n", "case", "median ms", "p95 ms", "of limit");
  bool kept = true;
  for (const auto& c : cases) kept = tell(out, c) && kept;
  kept = judgePlanning(out, cases) && kept;
  return kept ? 0 : 1;
}

}  // namespace
}  // namespace pilothouse::bench

int main(int argc, char** argv) {
  using namespace pilothouse::bench;
  const BenchOptions options = readOptions(kCommand, argc, argv);
  try {
    return run(options);
  } catch (const std::exception& fault) {
    refuse(kCommand, fault.what());
  }
}
