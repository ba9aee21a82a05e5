// How long a frame takes to enter the maps, and a path over them. See --help.

#include "bench/limit_table.hpp"
#include "bench/map_cases.hpp"

namespace pilothouse::bench {
namespace {

const BenchCommand kCommand{
    "bench_maps",
    "usage: bench_maps [--rounds N] [--out FILE]\n"
    "Times a frame's way into the occupancy map (floor grid of a 640x480 picture, scan of 640\n"
    "beams, both with clearing) and into the octree at 5 cm, each beside a plain version of the\n"
    "same; and the planner on maps of up to 4000^2 cells beside textbook Dijkstra: from nothing,\n"
    "and anew where something came into the way.\n"
    "  --rounds N    5..100000 (default 300)\n"
    "  --out FILE    write a JSON object a line to FILE\n"
    "Ends with 1 where a stated limit is missed, 2 on a wrong call.\n",
    {}};

void run(const BenchOptions&, LimitTable& table) {
  std::vector<TimedCase> cases;
  addOccupancyCases(cases);
  addVolumeCases(cases);
  addPlanningCases(cases);
  table.measure(cases);
  for (const TimedCase& c : cases) {
    table.tell(c.name, quantile(c.times_ms, 0.5), quantile(c.times_ms, 0.95), c.limit);
  }
  judgePlanning(table, cases);
}

}  // namespace
}  // namespace pilothouse::bench

int main(int argc, char** argv) {
  using namespace pilothouse::bench;
  return runBench(kCommand, argc, argv, 4, run);
}
