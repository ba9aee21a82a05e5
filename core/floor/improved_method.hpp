#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "core/floor/floor_cells.hpp"
#include "core/floor/floor_parameters.hpp"
#include "core/floor/floor_patches.hpp"
#include "core/floor/floor_surface.hpp"
#include "core/floor/near_floor.hpp"

namespace pilothouse {

/// The original method's deviation limit, and what cures its two defects (flat tops that read as
/// floor, drop-offs that read as floor):
///  1. cells whose deviation, less what the sensor's noise explains, is within the limit are even;
///  2. even cells are flooded into patches, in steps of at most step_height;
///  3. the patch at the robot is its floor; a patch beyond a shadow joins where it continues the
///     floor's surface or the plane that the robot stands on, lies below as a drop-off or above as
///     an obstacle otherwise;
///  4. what a drop-off's edge hides, from the floor to the lower level along the ray, is drop-off.
class ImprovedMethod {
 public:
  void configure(const FloorParameters& parameters, const GridGeometry& geometry);
  /// @param grid with statistics filled in; its classes are overwritten.
  /// @param T_base_camera from the camera's optical frame into the base frame.
  /// @return the plane that the robot stands on, where enough of it shows.
  std::optional<FloorSlope> judge(const Eigen::Isometry3f& T_base_camera, FloorCells& grid);

 private:
  enum class PatchKind : std::uint8_t { kUndecided, kJoining, kFloor, kAbove, kBelow };

  /// Raised points are an obstacle from here on: a little above the step that floor may have [m].
  float highStep() const { return 1.2F * static_cast<float>(parameters_.step_height); }
  float fewestPoints() const { return static_cast<float>(parameters_.min_points) - 0.5F; }
  void updateNoise(const Eigen::Isometry3f& T_base_camera);
  void findEven(const FloorCells& grid);
  int robotPatch(const FloorCells& grid);
  bool hasEvenCell(int ix) const;
  void joinIslands(const FloorCells& grid, const Eigen::Vector3f& camera);
  template <class Expected>
  void sort(std::size_t number, const FloorCells& grid, Expected expected);
  bool isTop(std::size_t number, const Eigen::Vector3f& camera, const FloorCells& grid) const;
  bool takeIn(PatchKind kind, const FloorCells& grid);
  template <class Expected>
  float patchOffset(const FloorPatch& patch, const FloorCells& grid, Expected expected);
  float floorAt(int ix, int iy, const FloorCells& grid);
  bool hidesRaisedPart(std::size_t i, float variance, const FloorCells& grid);
  CellClass judgeFloorCell(std::size_t i, const FloorCells& grid);
  CellClass judgeUnevenCell(std::size_t i, const FloorCells& grid);
  void classify(FloorCells& grid);
  void dropLoneDropOffs(FloorCells& grid);
  void markHiddenByEdge(const Eigen::Vector3f& camera, FloorCells& grid);

  FloorParameters parameters_;
  GridGeometry geometry_;
  Eigen::Isometry3f T_base_camera_ = Eigen::Isometry3f::Identity();
  bool noise_known_ = false;
  std::vector<float> noise_variance_;  // of heights, a cell [m^2]
  std::vector<std::uint8_t> even_;
  std::vector<std::uint8_t> floor_;  // even cells of patches that are floor
  std::vector<PatchKind> kinds_;
  std::vector<float> votes_;    // a patch, scratch of robotPatch
  std::vector<float> offsets_;  // scratch of patchOffset
  FloorPatches patches_;
  FloorSurface surface_;
  NearFloor near_floor_;
  std::optional<FloorSlope> home_;  // the plane that the robot stands on
};

}  // namespace pilothouse
