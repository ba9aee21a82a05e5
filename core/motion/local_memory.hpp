#pragma once

#include <cstdint>
#include <vector>

#include "core/floor/floor_cells.hpp"
#include "core/motion/avoidance_parameters.hpp"
#include "core/motion/footprint.hpp"
#include "core/motion/obstacle.hpp"
#include "core/motion/planar.hpp"

namespace pilothouse {

/// A floor grid as borrowed from a FloorCells or a message. Arrays have geometry.cells() entries.
struct FloorFrame {
  double stamp = 0.0;  ///< [s]
  GridGeometry geometry;
  const CellClass* classes = nullptr;
  const float* heights = nullptr;  ///< [m]
};

/// What the camera has seen round the robot, in a window of 10 x 10 m of the odometry frame that
/// goes along with it: things that left the view or came nearer than the camera sees stay until
/// they are seen free, are driven off, or are too old. Also tells where something has looked at
/// all. Fixed size: allocates when made and never again.
class LocalMemory {
 public:
  LocalMemory(const AvoidanceParameters& parameters, const Footprint& footprint);
  void setParameters(const AvoidanceParameters& parameters) { parameters_ = parameters; }

  /// @param pose of the base in the odometry frame at the frame's stamp.
  void add(const FloorFrame& frame, const Pose2& pose);
  /// The robot stands here: nothing else does.
  void drivenOver(const Pose2& pose, double now);
  /// A cone of the odometry frame in which a range sensor sees nothing: what is remembered there,
  /// came there while the camera watched and is higher than `least_height` [m] has gone on.
  /// @param sensor its apex and axis; @param half_angle [rad]; @param range of the free part [m].
  void seenFree(const Pose2& sensor, double half_angle, double range, double least_height);

  /// Appends what counts now to `objects`, in the base frame: of the newest view, and remembered.
  /// A lone speckle counts once it was seen often enough, or is near.
  /// @param pose of the base in the odometry frame at `now`.
  void collect(const Pose2& pose, double now, std::vector<Obstacle>& objects) const;
  /// True when something looked at this place of the odometry frame not longer ago than the memory
  /// lasts, or the robot stood there.
  bool looked(const Eigen::Vector2d& place, double now) const;
  void clear();

 private:
  struct Cell {
    std::int32_t ix = 0, iy = 0;  ///< which cell of the endless grid is kept here
    float dx = 0.0F, dy = 0.0F;   ///< of the object from the cell's centre [m]
    float height = 0.0F;          ///< of the object [m]
    float size = 0.0F;            ///< of the object [m]
    float seen = -1.0F;           ///< when something last looked here, since start_ [s]; < 0: never
    float hit = 0.0F;             ///< when the object was last seen [s]
    std::uint32_t frame = 0;      ///< number of the last frame that looked here; 0: none
    std::uint8_t history = 0;     ///< newest look in bit 0: 1 was an object
    std::uint8_t looks = 0;       ///< how many bits of it mean something
    CellClass kind = CellClass::kUnknown;  ///< of the object; kUnknown: none
    bool lone = false;                     ///< its newest hit had no neighbour
    bool arrived = false;                  ///< was seen free before: may go on again
  };
  void begin(double time);
  Cell& at(std::int32_t ix, std::int32_t iy);
  const Cell* find(std::int32_t ix, std::int32_t iy) const;
  void note(Cell& cell, bool object, float now) const;
  void mark(const FloorFrame& frame, const Pose2& pose);
  void look(const FloorFrame& frame, const Pose2& pose);
  bool counts(const Cell& cell, const Eigen::Vector2d& in_base) const;
  bool confirmed(const Cell& cell) const;
  float since(double time) const { return static_cast<float>(time - start_); }

  AvoidanceParameters parameters_;
  Footprint footprint_;
  std::vector<Cell> cells_;
  std::vector<Eigen::Vector2d> outline_;  ///< of the footprint, odometry frame; reused
  double start_ = 0.0;                    ///< times are kept since then [s]
  bool begun_ = false;
  std::uint32_t frame_ = 0;
};

}  // namespace pilothouse
