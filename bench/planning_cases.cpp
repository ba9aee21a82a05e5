#include <algorithm>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>

#include "bench/json_line.hpp"
#include "bench/map_cases.hpp"
#include "core/planning/planner.hpp"
#include "core/planning/textbook_dijkstra.hpp"
#include "sim/random.hpp"

namespace pilothouse::bench {
namespace {

constexpr double kFrameMs = 1000.0 / 30.0;  // a way that is blocked must be planned anew within
constexpr double kOfDijkstra = 0.5;         // a map of 1000^2 taken and planned over
constexpr double kGrowth = 10.0;            // 4000^2 cells over 1000^2, a cell
constexpr int kFreeCorner = 40;             // [cells]

/// Boxes of 0.1 to 0.8 m, one on 2,500 cells; the corners are free.
MapCells furnished(int side) {
  sim::Random random(3);
  MapCells map;
  map.size_x = map.size_y = side;
  map.cells.assign(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), MapCell::kFree);
  const auto below = [&random](int n) { return static_cast<int>(random.uniform(0.0, n)); };
  const auto fill = [&map](int x0, int y0, int x1, int y1, MapCell kind) {
    for (int y = y0; y < std::min(map.size_y, y1); ++y) {
      for (int x = x0; x < std::min(map.size_x, x1); ++x) map.cells[map.index(x, y)] = kind;
    }
  };
  for (int i = 0; i < side * (side / 2500.0); ++i) {
    const int x = below(side), y = below(side);
    fill(x, y, x + 2 + below(14), y + 2 + below(14), MapCell::kOccupied);
  }
  fill(0, 0, kFreeCorner, kFreeCorner, MapCell::kFree);
  fill(side - kFreeCorner, side - kFreeCorner, side, side, MapCell::kFree);
  return map;
}

struct Ground {
  MapCells map;
  Planner planner;
  PlanRequest request;
  bool blocked = false;

  explicit Ground(int side)
      : map(furnished(side)),
        planner({}, Footprint({{0.25, 0.2}, {-0.25, 0.2}, {-0.25, -0.2}, {0.25, -0.2}}),
                BaseKind::kFourWheelSteered) {
    planner.setMap(map);
    request.start = {map.centreX(kFreeCorner / 2), map.centreY(kFreeCorner / 2), 0.8};
    request.goal = {map.centreX(side - kFreeCorner / 2), map.centreY(side - kFreeCorner / 2)};
    if (!planner.plan(request)) throw std::logic_error("the benchmark's map has no way");
  }
  Cell cellOf(const Eigen::Vector2d& place) const {
    return {map.column(place.x()), map.row(place.y())};
  }
  /// Something stands in the way, a few metres ahead; the next time it is gone.
  void block() {
    blocked = !blocked;
    std::vector<Planner::Mark> marks;
    if (blocked) marks.push_back({request.start.position() + Eigen::Vector2d(2.0, 2.0), 0.4});
    planner.mark(marks);
    planner.plan(request);
  }
};

std::string named(const std::string& what, int side) {
  return what + ", " + std::to_string(side) + "^2";
}

double medianOf(const std::vector<TimedCase>& cases, const std::string& name) {
  const auto found =
      std::find_if(cases.begin(), cases.end(), [&](const TimedCase& c) { return c.name == name; });
  if (found == cases.end()) throw std::logic_error("no case " + name);
  return quantile(found->times_ms, 0.5);
}

}  // namespace

void addPlanningCases(std::vector<TimedCase>& cases) {
  for (const int side : {400, 1000, 4000}) {
    const auto ground = std::make_shared<Ground>(side);
    const bool large = side > 1000;
    cases.push_back({named("planner: map taken", side),
                     [ground] { ground->planner.setMap(ground->map); },
                     {},
                     large,
                     {},
                     {}});
    cases.push_back({named("planner: way", side),
                     [ground] { ground->planner.plan(ground->request); },
                     {},
                     large,
                     {},
                     {}});
    TimedCase anew{named("planner: blocked, way anew", side),
                   [ground] { ground->block(); },
                   {},
                   large,
                   {},
                   {}};
    if (!large) anew.limit = kFrameMs;
    cases.push_back(anew);
    if (large) continue;
    cases.push_back({named("textbook Dijkstra", side),
                     [ground] {
                       textbookDijkstra(ground->planner.field(),
                                        ground->cellOf(ground->request.start.position()),
                                        ground->cellOf(ground->request.goal));
                     },
                     {},
                     true,
                     {},
                     {}});
  }
}

bool judgePlanning(std::ostream& out, const std::vector<TimedCase>& cases) {
  const auto whole = [&](int side) {
    return medianOf(cases, named("planner: map taken", side)) +
           medianOf(cases, named("planner: way", side));
  };
  const double dijkstra = whole(1000) / medianOf(cases, named("textbook Dijkstra", 1000));
  const double growth = whole(4000) / (16.0 * whole(1000));
  bool kept = true;
  const auto tell = [&](const char* name, double ratio, double limit, const char* of) {
    JsonLine line;
    line.text("bench", "maps").text("case", name).number("ratio", ratio, 3).text("of", of);
    line.number("limit", limit, 2).truth("pass", ratio <= limit);
    std::printf("%-66s %8.3f  of %g at most%s\n", name, ratio, limit,
                ratio <= limit ? "" : "  MISSED");
    out << line.str() << '\n';
    kept = kept && ratio <= limit;
  };
  tell("planner, 1000^2: map and way over textbook Dijkstra's way", dijkstra, kOfDijkstra,
       "textbook Dijkstra, 1000^2");
  tell("planner: a cell of 4000^2 over one of 1000^2", growth, kGrowth, "planner, 1000^2");
  return kept;
}

}  // namespace pilothouse::bench
