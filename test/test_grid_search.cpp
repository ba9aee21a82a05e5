// What a planner is made of: distances, costs, the search and the smoothing.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/planning/path_smoother.hpp"
#include "core/planning/reach.hpp"
#include "core/planning/textbook_dijkstra.hpp"
#include "test/map_rooms.hpp"

namespace pilothouse {
namespace {

constexpr double kInscribed = 0.2, kReach = 0.6;

Cell freeCell(const CostField& field, std::mt19937& random) {
  for (int i = 0; i < 10000; ++i) {
    const Cell cell{static_cast<int>(random() % static_cast<unsigned>(field.sizeX())),
                    static_cast<int>(random() % static_cast<unsigned>(field.sizeY()))};
    if (field.weight(cell.x, cell.y) != 0) return cell;
  }
  return {-1, -1};
}

MapRoom randomRoom(std::mt19937& random) {
  MapRoom room(40 + static_cast<int>(random() % 100), 40 + static_cast<int>(random() % 100));
  room.addBoxes(random, static_cast<int>(random() % 40));
  const auto patch = [&](MapCell kind) {
    const int x = static_cast<int>(random() % 120), y = static_cast<int>(random() % 120);
    room.fill(x, y, x + static_cast<int>(random() % 30), y + static_cast<int>(random() % 30), kind);
  };
  patch(MapCell::kThreshold);
  patch(MapCell::kUnknown);
  patch(MapCell::kDropOff);
  return room;
}

TEST(ClearanceField, AgreesWithLookingAtEveryCell) {
  std::mt19937 random(1);
  for (int run = 0; run < 30; ++run) {
    const int size_x = 1 + static_cast<int>(random() % 60),
              size_y = 1 + static_cast<int>(random() % 60);
    const int reach = 1 + static_cast<int>(random() % 20);
    std::vector<std::uint8_t> blocked(static_cast<std::size_t>(size_x * size_y));
    for (auto& cell : blocked) cell = random() % 60 == 0 ? 1 : 0;
    ClearanceField field;
    field.resize(size_x, size_y, reach);
    field.update(blocked.data(), {0, 0, size_x, size_y});
    // Then some cells change, and only their window is done again.
    CellWindow changed;
    for (int i = 0; i < 5; ++i) {
      const int x = static_cast<int>(random() % static_cast<unsigned>(size_x));
      const int y = static_cast<int>(random() % static_cast<unsigned>(size_y));
      auto& cell = blocked[static_cast<std::size_t>(y * size_x + x)];
      cell = cell == 0 ? 1 : 0;
      changed.include(x, y);
    }
    field.update(blocked.data(), changed);
    for (int y = 0; y < size_y; ++y) {
      for (int x = 0; x < size_x; ++x) {
        int least = field.most();
        for (int v = 0; v < size_y; ++v) {
          for (int u = 0; u < size_x; ++u) {
            if (blocked[static_cast<std::size_t>(v * size_x + u)] == 0) continue;
            least = std::min(least, (x - u) * (x - u) + (y - v) * (y - v));
          }
        }
        ASSERT_EQ(field.square(x, y), least) << "cell " << x << " " << y << " in run " << run;
      }
    }
  }
}

TEST(CostField, WeightsRiseNearThingsAndEndAtTheLeastClearance) {
  MapRoom room(100, 60);
  room.fill(50, 1, 60, 59, MapCell::kThreshold);
  const PlanningParameters parameters;
  CostField field(parameters, kInscribed, kReach);
  field.take(room.map);
  for (int y = 1; y < 30; ++y) {
    const double clearance = 0.05 * (y - 0.5);
    EXPECT_NEAR(field.clearance(25, y), clearance > 0.64 ? 1000.0 : clearance, 1e-9) << y;
    if (clearance < kInscribed + parameters.clearance - 1e-9) {
      EXPECT_EQ(field.weight(25, y), 0) << y;
    } else {
      EXPECT_GE(field.weight(25, y), CostField::kPlain);
      EXPECT_LE(field.weight(25, y), field.weight(25, y - 1) == 0 ? 255 : field.weight(25, y - 1));
    }
  }
  EXPECT_EQ(field.weight(25, 30), CostField::kPlain);
  EXPECT_EQ(field.weight(55, 30), 3 * CostField::kPlain) << "a threshold costs three times as much";
}

TEST(CostField, UpdatedInAWindowIsAsIfNew) {
  std::mt19937 random(2);
  for (int run = 0; run < 20; ++run) {
    MapRoom room = randomRoom(random);
    CostField updated({}, kInscribed, kReach), fresh({}, kInscribed, kReach);
    updated.take(room.map);
    CellWindow changed;
    for (int i = 0; i < 6; ++i) {
      const int x = static_cast<int>(random() % 40), y = static_cast<int>(random() % 40);
      room.map.cells[room.map.index(x, y)] = static_cast<MapCell>(random() % 5);
      changed.include(x, y);
    }
    updated.update(room.map, changed);
    fresh.take(room.map);
    ASSERT_EQ(updated.weights(), fresh.weights());
  }
}

TEST(GridSearch, FindsTheTextbooksCostOnHundredsOfRandomMaps) {
  std::mt19937 random(3);
  GridSearch search;
  Reach reach;
  std::vector<Cell> way;
  int found = 0, none = 0;
  for (int run = 0; run < 400; ++run) {
    const MapRoom room = randomRoom(random);
    CostField field({}, kInscribed, kReach);
    field.take(room.map);
    const Cell start = freeCell(field, random), goal = freeCell(field, random);
    if (start.x < 0) continue;
    const auto cost = search.find(field, start, goal);
    ASSERT_EQ(cost, TextbookDijkstra().find(field, start, goal)) << "run " << run;
    reach.spread(field, start);
    ASSERT_EQ(reach.holds(field, goal), cost.has_value());
    ++(cost ? found : none);
    if (!cost) continue;
    search.trace(way);
    ASSERT_TRUE(way.front() == start && way.back() == goal);
    std::uint32_t sum = 0;
    for (std::size_t i = 1; i < way.size(); ++i) {
      const int dx = std::abs(way[i].x - way[i - 1].x), dy = std::abs(way[i].y - way[i - 1].y);
      ASSERT_EQ(std::max(dx, dy), 1);
      sum += (dx + dy == 2 ? GridSearch::kSlant : GridSearch::kStraight) *
             (std::uint32_t{field.weight(way[i].x, way[i].y)} +
              field.weight(way[i - 1].x, way[i - 1].y));
    }
    ASSERT_EQ(sum, *cost);
  }
  EXPECT_GT(found, 200);
  EXPECT_GT(none, 20) << "too few maps without a way to say anything about them";
}

/// What may happen to a map: things come and go, here or all over; a door shuts.
CellWindow changeAnything(MapRoom& room, std::mt19937& random) {
  const auto below = [&random](int n) {
    return static_cast<int>(random() % static_cast<unsigned>(n));
  };
  CellWindow changed;
  const int places = 1 + below(4);
  for (int i = 0; i < places; ++i) {
    const int x = below(room.map.size_x), y = below(room.map.size_y);
    const bool wall = below(6) == 0;
    const int to_x = std::min(room.map.size_x, x + 1 + below(wall ? 80 : 8));
    const int to_y = std::min(room.map.size_y, y + 1 + below(wall ? 2 : 8));
    const bool gone = below(2) == 0;
    room.fill(x, y, to_x, to_y, gone ? MapCell::kFree : static_cast<MapCell>(below(5)));
    changed.include(x, y);
    changed.include(to_x - 1, to_y - 1);
  }
  return changed;
}

TEST(GridSearch, MendedIsAsFromNothingOnHundredsOfRandomMaps) {
  std::mt19937 random(7);
  GridSearch mended;
  std::vector<Cell> way, fresh_way;
  int found = 0, none = 0;
  std::size_t mended_cells = 0, fresh_cells = 0;
  for (int run = 0; run < 300; ++run) {
    MapRoom room = randomRoom(random);
    CostField field({}, kInscribed, kReach);
    field.take(room.map);
    const Cell goal = freeCell(field, random);
    Cell start = freeCell(field, random);
    for (int change = 0; change < 12 && start.x >= 0; ++change) {
      if (field.weight(goal.x, goal.y) == 0) break;
      if (field.weight(start.x, start.y) == 0) start = freeCell(field, random);
      const auto cost = mended.find(field, start, goal);
      GridSearch fresh;
      ASSERT_EQ(cost, fresh.find(field, start, goal)) << "run " << run << ", change " << change;
      ASSERT_EQ(cost, TextbookDijkstra().find(field, start, goal));
      ++(cost ? found : none);
      if (change > 0) {
        mended_cells += mended.expanded();
        fresh_cells += fresh.expanded();
      }
      if (cost) {
        mended.trace(way);
        fresh.trace(fresh_way);
        ASSERT_EQ(way, fresh_way) << "run " << run << ", change " << change;
        start = way[std::min<std::size_t>(way.size() - 1, random() % 12)];
      }
      // Some searches see several changes at once, and cells that a planner closed and opened.
      for (auto i = random() % 3; i < 2; ++i) {
        field.update(room.map, changeAnything(room, random));
      }
      if (random() % 3 == 0) field.set(start.x + 1, start.y, static_cast<int>(random() % 2) * 32);
    }
  }
  EXPECT_GT(found, 1000);
  EXPECT_GT(none, 100);
  EXPECT_LT(2 * mended_cells, fresh_cells) << "mending is to save work";
}

TEST(GridSearch, TakesAnotherFieldForAnother) {
  GridSearch search;
  std::optional<std::uint32_t> costs[2];
  for (const bool walled : {false, true}) {
    // Both lie at the same place in memory, and are of one size.
    MapRoom room(60, 60);
    if (walled) room.fill(30, 0, 32, 60);
    CostField field({}, kInscribed, kReach);
    field.take(room.map);
    costs[walled ? 1 : 0] = search.find(field, {15, 30}, {45, 30});
  }
  EXPECT_TRUE(costs[0]);
  EXPECT_FALSE(costs[1]);
}

TEST(PathSmoother, NeverCostsMoreAndNeverTouchesWhatIsClosed) {
  std::mt19937 random(4);
  GridSearch search;
  PathSmoother smoother;
  std::vector<Cell> way;
  std::vector<GridPoint> points;
  for (int run = 0; run < 400; ++run) {
    const MapRoom room = randomRoom(random);
    CostField field({}, kInscribed, kReach);
    field.take(room.map);
    const Cell start = freeCell(field, random), goal = freeCell(field, random);
    if (start.x < 0) continue;
    const auto cost = search.find(field, start, goal);
    if (!cost) continue;
    search.trace(way);
    smoother.smooth(field, way, points);
    ASSERT_EQ(points.front(), GridPoint(start.x + 0.5, start.y + 0.5));
    ASSERT_EQ(points.back(), GridPoint(goal.x + 0.5, goal.y + 0.5));
    double sum = 0.0;
    for (std::size_t i = 1; i < points.size(); ++i) {
      double leg = 0.0;
      const GridPoint step = points[i] - points[i - 1];
      const int pieces = static_cast<int>(step.norm() * 50.0) + 1;
      for (int k = 0; k < pieces; ++k) {
        const GridPoint at = points[i - 1] + (k + 0.5) / pieces * step;
        int weight = field.weight(static_cast<int>(at.x()), static_cast<int>(at.y()));
        // A hair aside: it may pass through a closed cell's corner.
        for (int hair = 0; hair < 4 && weight == 0; ++hair) {
          weight = field.weight(static_cast<int>(at.x() + (hair < 2 ? 1e-5 : -1e-5)),
                                static_cast<int>(at.y() + (hair % 2 == 0 ? 1e-5 : -1e-5)));
        }
        ASSERT_NE(weight, 0) << "run " << run << " at " << at.transpose();
        leg += weight * step.norm() / pieces / CostField::kPlain;
      }
      ASSERT_NEAR(straightCost(field, points[i - 1], points[i], HUGE_VAL), leg, 0.02 * leg + 0.15);
      sum += leg;
    }
    EXPECT_LE(sum, 1.01 * *cost / GridSearch::kUnit + 0.1) << "run " << run;
  }
}

}  // namespace
}  // namespace pilothouse
