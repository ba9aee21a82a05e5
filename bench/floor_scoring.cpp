#include "bench/floor_scoring.hpp"

#include <algorithm>
#include <cmath>

namespace pilothouse::bench {
namespace {

std::uint32_t of(const SurfaceCounts& counts, sim::Surface surface) {
  return counts[static_cast<std::size_t>(surface)];
}

std::uint32_t obstaclesIn(const SurfaceCounts& counts) {
  return of(counts, sim::Surface::kBox7cm) + of(counts, sim::Surface::kBox18cm) +
         of(counts, sim::Surface::kObstacle);
}

std::uint32_t allIn(const SurfaceCounts& counts) {
  std::uint32_t sum = 0;
  for (const std::uint32_t count : counts) sum += count;
  return sum;
}

CellTruth obstacleKind(const SurfaceCounts& counts) {
  const std::uint32_t low = of(counts, sim::Surface::kBox7cm);
  const std::uint32_t high = of(counts, sim::Surface::kBox18cm);
  const std::uint32_t other = of(counts, sim::Surface::kObstacle);
  if (low >= high && low >= other) return CellTruth::kBox7cm;
  return high >= other ? CellTruth::kBox18cm : CellTruth::kObstacle;
}

CellTruth truthOfPoints(const SurfaceCounts& counts, std::uint32_t min_points) {
  const std::uint32_t obstacles = obstaclesIn(counts);
  const std::uint32_t lower = of(counts, sim::Surface::kLowerLevel);
  if (allIn(counts) < min_points) return CellTruth::kUnseen;
  if (obstacles >= min_points) return obstacleKind(counts);
  if (lower >= min_points) return CellTruth::kBeyond;
  if (obstacles + lower + of(counts, sim::Surface::kBetween) > 0) return CellTruth::kUndecided;
  const std::uint32_t high = of(counts, sim::Surface::kRamp);
  // Floor and high ramp in one cell: its side or back, a ledge that the camera looks across.
  if (high > 0 && of(counts, sim::Surface::kFloor) > 0) return CellTruth::kUndecided;
  if (of(counts, sim::Surface::kSill) >= min_points) return CellTruth::kSill;
  if (high + of(counts, sim::Surface::kRampFoot) >= min_points) return CellTruth::kRamp;
  return CellTruth::kFloor;
}

/// How many of a cell's four corners lie past the edge.
int cornersBeyond(const sim::DropEdge& edge, const GridGeometry& geometry, int ix, int iy) {
  int beyond = 0;
  for (int corner = 0; corner < 4; ++corner) {
    const Eigen::Vector2d p(
        geometry.x_min + geometry.cell_size * static_cast<float>(ix + corner % 2),
        geometry.y_min + geometry.cell_size * static_cast<float>(iy + corner / 2));
    if (edge.normal.dot(p) > edge.offset) ++beyond;
  }
  return beyond;
}

bool isBlocked(CellClass c) {
  return c == CellClass::kObstacle || c == CellClass::kDropOff;
}

/// True where a cell that ought to be blocked is this one or one of its eight neighbours.
bool hasBlockedNear(const std::vector<CellTruth>& truth, const GridGeometry& g, int ix, int iy) {
  for (int y = std::max(0, iy - 1); y <= std::min(g.size_y - 1, iy + 1); ++y) {
    for (int x = std::max(0, ix - 1); x <= std::min(g.size_x - 1, ix + 1); ++x) {
      const CellTruth t = truth[g.index(x, y)];
      if (isObstacle(t) || t == CellTruth::kBeyond) return true;
    }
  }
  return false;
}

}  // namespace

void countSurfaces(const std::vector<float>& depths, const std::vector<sim::Surface>& surfaces,
                   const sim::CameraModel& camera, const Eigen::Isometry3d& T_base_optical,
                   const CellRule& rule, std::vector<SurfaceCounts>& counts) {
  const GridGeometry& g = rule.geometry;
  counts.assign(g.cells(), SurfaceCounts{});
  const Intrinsics& k = camera.intrinsics;
  for (std::size_t i = 0; i < depths.size(); ++i) {
    if (!(depths[i] > 0.0F)) continue;
    const double z = static_cast<double>(depths[i]);
    const Eigen::Vector3d ray((static_cast<double>(i % camera.width) - k.cx) / k.fx,
                              (static_cast<double>(i / camera.width) - k.cy) / k.fy, 1.0);
    const Eigen::Vector3d p = T_base_optical * (ray * z);
    if (!(p.z() <= rule.clear_height)) continue;
    const int ix = static_cast<int>(
        std::floor((p.x() - static_cast<double>(g.x_min)) / static_cast<double>(g.cell_size)));
    const int iy = static_cast<int>(
        std::floor((p.y() - static_cast<double>(g.y_min)) / static_cast<double>(g.cell_size)));
    if (g.contains(ix, iy)) ++counts[g.index(ix, iy)][static_cast<std::size_t>(surfaces[i])];
  }
}

std::vector<CellTruth> truthOf(const std::vector<SurfaceCounts>& counts, const CellRule& rule,
                               const std::optional<sim::DropEdge>& edge) {
  const GridGeometry& g = rule.geometry;
  std::vector<CellTruth> truth(counts.size());
  for (int iy = 0; iy < g.size_y; ++iy) {
    for (int ix = 0; ix < g.size_x; ++ix) {
      const std::size_t i = g.index(ix, iy);
      truth[i] = truthOfPoints(counts[i], rule.min_points);
      const int beyond = edge ? cornersBeyond(*edge, g, ix, iy) : 0;
      if (beyond == 4) {
        truth[i] = CellTruth::kBeyond;
      } else if (beyond > 0 && isDrivable(truth[i])) {
        truth[i] = CellTruth::kUndecided;
      }
    }
  }
  return truth;
}

std::vector<CellClass> ceilingOf(const std::vector<SurfaceCounts>& counts, const CellRule& rule) {
  std::vector<CellClass> classes(counts.size(), CellClass::kUnknown);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (allIn(counts[i]) < rule.min_points) continue;
    if (obstaclesIn(counts[i]) >= rule.min_points) {
      classes[i] = CellClass::kObstacle;
    } else if (of(counts[i], sim::Surface::kLowerLevel) >= rule.min_points) {
      classes[i] = CellClass::kDropOff;
    } else {
      classes[i] = CellClass::kFloor;
    }
  }
  return classes;
}

void FloorScore::add(const FloorScore& other) {
  iou.add(other.iou);
  precision.add(other.precision);
  recall_7cm.add(other.recall_7cm);
  recall_18cm.add(other.recall_18cm);
  recall.add(other.recall);
  ramp_drivable.add(other.ramp_drivable);
  sill_drivable.add(other.sill_drivable);
  floor_drivable.add(other.floor_drivable);
  false_on_empty.add(other.false_on_empty);
  beyond_blocked.add(other.beyond_blocked);
  measured.add(other.measured);
  recall_7cm_strict.add(other.recall_7cm_strict);
  recall_18cm_strict.add(other.recall_18cm_strict);
  ramp_strict.add(other.ramp_strict);
  sill_strict.add(other.sill_strict);
}

std::vector<bool> measuredIn(const std::vector<SurfaceCounts>& counts, const CellRule& rule) {
  std::vector<bool> measured(counts.size());
  for (std::size_t i = 0; i < counts.size(); ++i) measured[i] = allIn(counts[i]) >= rule.min_points;
  return measured;
}

FloorScore score(const SceneTruth& scene, const std::vector<CellClass>& classes,
                 const GridGeometry& geometry, const ScoredRange& range) {
  const std::vector<CellTruth>& truth = scene.cells;
  FloorScore s;
  for (int iy = 0; iy < geometry.size_y; ++iy) {
    for (int ix = 0; ix < geometry.size_x; ++ix) {
      const double x = static_cast<double>(geometry.centreX(ix));
      if (x < range.x_min || x > range.x_max) continue;
      const CellTruth t = truth[geometry.index(ix, iy)];
      const CellClass c = classes[geometry.index(ix, iy)];
      if (t == CellTruth::kUnseen || t == CellTruth::kUndecided) continue;
      if (isBlocked(c)) s.precision.count(hasBlockedNear(truth, geometry, ix, iy));
      if (t == CellTruth::kBeyond) {
        s.beyond_blocked.count(!isDrivable(c));
        continue;
      }
      const bool measured = scene.measured[geometry.index(ix, iy)];
      s.measured.count(measured);
      if (t == CellTruth::kRamp) s.ramp_strict.count(isDrivable(c));
      if (t == CellTruth::kSill) s.sill_strict.count(isDrivable(c));
      const bool found = c == CellClass::kObstacle;
      const bool low = t == CellTruth::kBox7cm && x <= range.x_max_7cm;
      if (low) s.recall_7cm_strict.count(found);
      if (t == CellTruth::kBox18cm) s.recall_18cm_strict.count(found);
      if (!measured && c == CellClass::kUnknown) continue;
      if (isObstacle(t)) s.recall.count(found);
      // A drop-off where there is floor is as false as an obstacle there.
      if (isObstacle(t) || isBlocked(c)) s.iou.count(isObstacle(t) && found);
      if (t == CellTruth::kBox18cm) s.recall_18cm.count(found);
      if (low) s.recall_7cm.count(found);
      if (t == CellTruth::kRamp) s.ramp_drivable.count(isDrivable(c));
      if (t == CellTruth::kSill) s.sill_drivable.count(isDrivable(c));
      if (t == CellTruth::kFloor) s.floor_drivable.count(isDrivable(c));
      if (t == CellTruth::kFloor && scene.is_empty) s.false_on_empty.count(isBlocked(c));
    }
  }
  return s;
}

}  // namespace pilothouse::bench
