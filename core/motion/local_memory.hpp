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

/// What the camera has seen round the robot, in a window of the odometry frame that goes along with
/// it: things that left the view or came nearer than the camera sees stay until they are seen free,
/// are driven off, or are too old. Also tells where something has looked at all. Fixed size, no
/// allocation.
class LocalMemory {
 public:
  LocalMemory(const AvoidanceParameters& parameters, const Footprint& footprint);
  void setParameters(const AvoidanceParameters& parameters);

  /// @param pose of the base in the odometry frame at the frame's stamp.
  void add(const FloorFrame& frame, const Pose2& pose);
  /// The robot stands here: nothing else does.
  void drivenOver(const Pose2& pose, double now);
  /// A range sensor looks along this ray [odometry frame] and sees nothing up to its end: tall
  /// things that were remembered there are gone.
  void seenFree(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double half_angle,
                double least_height, double now);

  /// Appends what counts now to `objects`, in the base frame: of the newest view, and remembered.
  /// @param pose of the base in the odometry frame at `now`.
  void collect(const Pose2& pose, double now, std::vector<Obstacle>& objects) const;
  /// True when something looked at this place of the odometry frame not longer ago than the memory
  /// lasts, or the robot stood there.
  bool looked(const Eigen::Vector2d& place, double now) const;
  void clear();

 private:
  struct Cell {
    std::int32_t ix, iy;  ///< which cell of the endless grid is kept here
    float x, y;           ///< of the object, odometry frame [m], relative to the cell's centre
    float height;
    float seen;            ///< when something last looked here, since start_ [s]; negative: never
    float hit;             ///< when an object was last seen here [s]
    std::uint8_t history;  ///< newest look in bit 0: 1 was an object
    CellClass kind;        ///< of the object; kUnknown: none
    std::uint32_t frame;   ///< number of the last frame that looked here
    bool lone;             ///< its newest hit had no neighbour
  };
  Cell& at(std::int32_t ix, std::int32_t iy);
  const Cell* find(std::int32_t ix, std::int32_t iy) const;
  bool counts(const Cell& cell, std::int32_t ix, std::int32_t iy, double gap) const;
  void mark(const FloorFrame& frame, const Pose2& pose);
  void look(const FloorFrame& frame, const Pose2& pose);

  AvoidanceParameters parameters_;
  const Footprint footprint_;
  std::vector<Cell> cells_;
  double start_ = 0.0;
  bool started_ = false;
  std::uint32_t frame_ = 0;
};

}  // namespace pilothouse
