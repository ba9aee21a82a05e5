#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

#include "bench/map_cases.hpp"
#include "core/planning/planner.hpp"
#include "core/planning/textbook_dijkstra.hpp"
#include "sim/random.hpp"

namespace pilothouse::bench {
namespace {

constexpr double kFrameMs = 1000.0 / 30.0;  // a way that is blocked must be planned anew within
constexpr double kSaidMs = 1000.0;          // that there is no way must be said within
constexpr double kOfDijkstra = 0.5;         // a map of 1000^2 taken and planned over
constexpr double kGrowth = 10.0;            // 4000^2 cells over 1000^2, a cell
constexpr int kFreeCorner = 40;             // [cells]
constexpr int kRoom = 120;                  // [cells]

void fill(MapCells& map, int x0, int y0, int x1, int y1, MapCell kind) {
  for (int y = std::max(0, y0); y < std::min(map.size_y, y1); ++y) {
    for (int x = std::max(0, x0); x < std::min(map.size_x, x1); ++x) {
      map.cells[map.index(x, y)] = kind;
    }
  }
}

/// Boxes of 0.1 to 0.8 m, one on 2,500 cells; the corners are free.
MapCells furnished(int side, std::uint64_t seed) {
  sim::Random random(seed);
  MapCells map;
  map.size_x = map.size_y = side;
  map.cells.assign(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), MapCell::kFree);
  const auto below = [&random](int n) { return static_cast<int>(random.uniform(0.0, n)); };
  for (int i = 0; i < side * (side / 2500.0); ++i) {
    const int x = below(side), y = below(side);
    fill(map, x, y, x + 2 + below(14), y + 2 + below(14), MapCell::kOccupied);
  }
  fill(map, 0, 0, kFreeCorner, kFreeCorner, MapCell::kFree);
  fill(map, side - kFreeCorner, side - kFreeCorner, side, side, MapCell::kFree);
  return map;
}

/// Rooms of 6 m, seven of ten walls with a door of 1.1 m.
MapCells rooms(int side) {
  sim::Random random(5);
  MapCells map;
  map.size_x = map.size_y = side;
  map.cells.assign(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), MapCell::kFree);
  for (int at = 0; at <= side; at += kRoom) {
    fill(map, at - 2, 0, at + 2, side, MapCell::kOccupied);
    fill(map, 0, at - 2, side, at + 2, MapCell::kOccupied);
  }
  const auto open = [&](int wall, int room, bool upright, bool always) {
    const int width = std::min(kRoom, side - room);
    const int middle = room + 15 + static_cast<int>(random.uniform(0.0, width - 30.0));
    if (random.uniform(0.0, 1.0) > 0.7 && !always) return;
    if (upright) {
      fill(map, wall - 2, middle - 11, wall + 2, middle + 11, MapCell::kFree);
    } else {
      fill(map, middle - 11, wall - 2, middle + 11, wall + 2, MapCell::kFree);
    }
  };
  for (int wall = kRoom; wall < side; wall += kRoom) {
    for (int room = 0; room < side; room += kRoom) {
      // There always is a way, and another one out of the first room.
      open(wall, room, true, room == 0);
      open(wall, room, false, wall == kRoom || room + kRoom >= side);
    }
  }
  return map;
}

/// A robot on a map, on its way from one corner to the other.
struct Ground {
  MapCells map;
  Planner planner;
  PlanRequest request;
  Route way;
  int step = 0;
  bool blocked = false;
  TextbookDijkstra dijkstra;

  explicit Ground(MapCells cells)
      : map(std::move(cells)),
        planner({}, Footprint({{0.25, 0.2}, {-0.25, 0.2}, {-0.25, -0.2}, {0.25, -0.2}}),
                BaseKind::kFourWheelSteered) {
    planner.setMap(map);
    const int last = map.size_x - kFreeCorner / 2;
    request.start = {map.centreX(kFreeCorner / 2), map.centreY(kFreeCorner / 2), 0.8};
    request.goal = {map.centreX(last), map.centreY(last)};
    const Plan plan = planner.plan(request);
    if (!plan) throw std::logic_error("the benchmark's map has no way");
    std::vector<Eigen::Vector2d> points;
    for (const Pose2& pose : plan.poses) points.push_back(pose.position());
    way = Route(points, planner.parameters().corners);
  }
  Cell cellOf(const Eigen::Vector2d& place) const {
    return {map.column(place.x()), map.row(place.y())};
  }
  /// From nothing: to another goal than before, one of two beside each other.
  void aim() {
    const int last = map.size_x - kFreeCorner / 2;
    request.goal = {map.centreX(last - (++step % 2)), map.centreY(last)};
  }
  void plan() {
    aim();
    planner.plan(request);
  }
  void planTextbook() {
    aim();
    if (!dijkstra.find(planner.field(), cellOf(request.start.position()), cellOf(request.goal))) {
      throw std::logic_error("the textbook finds no way");
    }
  }
  void planAnew(const std::vector<Planner::Mark>& marks) {
    planner.mark(marks);
    const Plan found = planner.plan(request);
    if (!found) throw std::logic_error(std::string("no way round: ") + textOf(found.why));
  }
  /// Nothing has changed: for caches.
  void again() { planner.plan(request); }
  /// Something stands in the way, a few metres ahead; the next time it is gone.
  void block() {
    request.start = {way.at(0.0).position.x(), way.at(0.0).position.y(), 0.8};
    std::vector<Planner::Mark> marks;
    blocked = !blocked;
    if (blocked) marks.push_back({way.at(2.8).position, 0.4});
    planAnew(marks);
  }
  /// The robot drives 20 m of its way, 3 cm a frame, and somebody walks to and fro 2 m before it.
  void drive() {
    const double along = 0.03 * (++step % 667);
    const Route::Place here = way.at(along), ahead = way.at(along + 2.0);
    request.start = {here.position.x(), here.position.y(),
                     std::atan2(here.direction.y(), here.direction.x())};
    const Eigen::Vector2d across(-ahead.direction.y(), ahead.direction.x());
    planAnew({{ahead.position + 1.5 * std::sin(0.05 * step) * across, 0.25}});
  }
  /// The door that it comes to next shuts, and opens again: round through other rooms.
  void shut() {
    std::vector<Planner::Mark> marks;
    blocked = !blocked;
    if (blocked) {
      const Route::Place door = nextDoor();
      const Eigen::Vector2d across(-door.direction.y(), door.direction.x());
      for (double off = -0.7; off <= 0.7; off += 0.1) {
        marks.push_back({door.position + off * across, 0.1});
      }
    }
    planAnew(marks);
  }
  /// Where the way first passes a wall.
  Route::Place nextDoor() const {
    double along = 0.0;
    const auto wallBeside = [&](double value) {
      const double room = kRoom * map.cell_size;
      return std::abs(value - room * std::round(value / room)) < 0.05 && value > 1.0;
    };
    for (; along < way.length(); along += 0.02) {
      const Eigen::Vector2d place = way.at(along).position;
      if (wallBeside(place.x()) || wallBeside(place.y())) break;
    }
    return way.at(along);
  }
};

/// A map of the same size with other things on it, each time.
struct Taken {
  MapCells maps[2];
  Planner planner;
  int step = 0;

  explicit Taken(int side)
      : maps{furnished(side, 3), furnished(side, 4)},
        planner({}, Footprint({{0.25, 0.2}, {-0.25, 0.2}, {-0.25, -0.2}, {0.25, -0.2}}),
                BaseKind::kFourWheelSteered) {}
  void other() { planner.setMap(maps[++step % 2]); }
  /// A few cells are otherwise, as after a look at something new.
  void same() {
    MapCells& map = maps[0];
    const MapCell kind = ++step % 2 == 0 ? MapCell::kFree : MapCell::kOccupied;
    fill(map, 60, 60, 64, 70, kind);
    planner.setMap(map);
  }
};

/// A wall without a door right through the middle: half of the map is searched in vain.
MapCells parted(int side) {
  MapCells map = furnished(side, 3);
  fill(map, side / 2, 0, side / 2 + 3, side, MapCell::kOccupied);
  return map;
}

std::string named(const std::string& what, int side) {
  return what + ", " + std::to_string(side) + "^2";
}

double medianOf(const std::vector<TimedCase>& cases, const std::string& name) {
  const auto found =
      std::find_if(cases.begin(), cases.end(), [&](const TimedCase& c) { return c.name == name; });
  if (found == cases.end()) throw std::logic_error("no case " + name);
  return quantile(found->times_ms, 0.5);
}

/// Each runs once before it is timed: all with caches as warm as they can be.
void add(std::vector<TimedCase>& cases, const std::string& name, bool slow,
         const std::function<void()>& work, const std::optional<double>& limit = std::nullopt) {
  cases.push_back({name, work, work, slow, limit, {}});
}

/// What is planned anew differs each time that it is timed, whatever warms the caches.
void addAnew(std::vector<TimedCase>& cases, const std::string& name,
             const std::function<void()>& work, const std::function<void()>& before) {
  cases.push_back({name, work, before, false, kFrameMs, {}});
}

}  // namespace

void addPlanningCases(std::vector<TimedCase>& cases) {
  for (const int side : {400, 1000, 4000}) {
    const bool large = side > 1000;
    const auto taken = std::make_shared<Taken>(side);
    const auto changed = std::make_shared<Taken>(side);
    const auto aimed = std::make_shared<Ground>(furnished(side, 3));
    const auto driven = std::make_shared<Ground>(furnished(side, 3));
    const auto inside = std::make_shared<Ground>(rooms(side));
    add(cases, named("planner: map taken", side), large, [taken] { taken->other(); });
    add(cases, named("planner: way", side), large, [aimed] { aimed->plan(); });
    const auto apart = std::make_shared<Ground>(furnished(side, 3));
    apart->planner.setMap(parted(side));
    add(
        cases, named("planner: no way, and why", side), large, [apart] { apart->plan(); }, kSaidMs);
    if (!large) {
      add(cases, named("textbook Dijkstra", side), true, [aimed] { aimed->planTextbook(); });
    }
    add(cases, named("planner: map taken, ten cells changed", side), large,
        [changed] { changed->same(); });
    addAnew(
        cases, named("planner: blocked or free, way anew", side), [driven] { driven->block(); },
        [driven] { driven->again(); });
    addAnew(
        cases, named("planner: somebody crosses, way anew", side), [driven] { driven->drive(); },
        [driven] { driven->drive(); });
    addAnew(
        cases, named("planner: door shut or open, way anew", side), [inside] { inside->shut(); },
        [inside] { inside->again(); });
  }
}

void judgePlanning(LimitTable& table, const std::vector<TimedCase>& cases) {
  const auto whole = [&](int side) {
    return medianOf(cases, named("planner: map taken", side)) +
           medianOf(cases, named("planner: way", side));
  };
  const double dijkstra = whole(1000) / medianOf(cases, named("textbook Dijkstra", 1000));
  table.tellRatio("planner, 1000^2: map and way over textbook Dijkstra's way", dijkstra,
                  kOfDijkstra, "textbook Dijkstra, 1000^2");
  table.tellRatio("planner: a cell of 4000^2 over one of 1000^2",
                  whole(4000) / (16.0 * whole(1000)), kGrowth, "planner, 1000^2");
}

}  // namespace pilothouse::bench
