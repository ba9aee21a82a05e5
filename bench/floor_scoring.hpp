#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/floor/floor_cells.hpp"
#include "sim/floor_scene.hpp"

namespace pilothouse::bench {

/// What a cell is. See docs/evaluation.md for the definitions.
enum class CellTruth : std::uint8_t {
  kUnseen,     ///< too few points: not scored
  kUndecided,  ///< holds a little of something not drivable, or an edge runs through: not scored
  kFloor,
  kRamp,
  kSill,
  kBox7cm,
  kBox18cm,
  kObstacle,  ///< any other obstacle
  kBeyond,    ///< past a step down, seen or not
};

inline bool isObstacle(CellTruth t) {
  return t == CellTruth::kBox7cm || t == CellTruth::kBox18cm || t == CellTruth::kObstacle;
}
inline bool isDrivable(CellTruth t) {
  return t == CellTruth::kFloor || t == CellTruth::kRamp || t == CellTruth::kSill;
}

/// Points of each surface in a cell, by sim::Surface.
using SurfaceCounts = std::array<std::uint32_t, sim::kSurfaces>;

/// How cells are told from points.
struct CellRule {
  GridGeometry geometry;
  double clear_height = 1.6;     ///< points above are ignored [m]
  std::uint32_t min_points = 3;  ///< of a sort that counts: the segmenter's own limit
};

/// Sorts labelled points into cells. @param depths along the optical axis [m], 0: none.
void countSurfaces(const std::vector<float>& depths, const std::vector<sim::Surface>& surfaces,
                   const sim::CameraModel& camera, const Eigen::Isometry3d& T_base_optical,
                   const CellRule& rule, std::vector<SurfaceCounts>& counts);

std::vector<CellTruth> truthOf(const std::vector<SurfaceCounts>& counts, const CellRule& rule,
                               const std::optional<sim::DropEdge>& edge);

/// The class that someone gives each cell who knows what every noisy point is.
std::vector<CellClass> ceilingOf(const std::vector<SurfaceCounts>& counts, const CellRule& rule);

struct Share {
  std::uint64_t part = 0;
  std::uint64_t whole = 0;
  void count(bool in_part) {
    ++whole;
    if (in_part) ++part;
  }
  void add(const Share& other) {
    part += other.part;
    whole += other.whole;
  }
  bool isKnown() const { return whole > 0; }
  double percent() const { return 100.0 * static_cast<double>(part) / static_cast<double>(whole); }
};

/// Counts of cells over any number of scenes.
struct FloorScore {
  Share iou;          ///< obstacle in both / obstacle in either
  Share precision;    ///< called obstacle or drop-off with such a cell within one cell
  Share recall_7cm;   ///< of cells of 7 cm boxes up to 2.5 m
  Share recall_18cm;  ///< of cells of 18 cm boxes
  Share recall;       ///< of all obstacle cells
  Share ramp_drivable;
  Share sill_drivable;
  Share floor_drivable;
  Share false_on_empty;  ///< of floor cells of scenes with nothing in them
  Share beyond_blocked;  ///< of cells past a step down: not drivable
  // Told beside, no bar of their own.
  Share measured;  ///< of scored cells short of a step down: enough noisy points, too
  // The same as above with the cells that the noisy camera did not measure counted as faults.
  Share recall_7cm_strict, recall_18cm_strict, ramp_strict, sill_strict;
  void add(const FloorScore& other);
};

struct ScoredRange {
  double x_min = 0.6;  ///< centre of a cell [m]
  double x_max = 3.5;
  double x_max_7cm = 2.5;
};

/// What a scene is in cells, and which cells the noisy view has enough points of.
struct SceneTruth {
  std::vector<CellTruth> cells;
  std::vector<bool> measured;
  bool is_empty = false;  ///< nothing but floor
};
std::vector<bool> measuredIn(const std::vector<SurfaceCounts>& counts, const CellRule& rule);

FloorScore score(const SceneTruth& scene, const std::vector<CellClass>& classes,
                 const GridGeometry& geometry, const ScoredRange& range = {});

}  // namespace pilothouse::bench
