#pragma once

#include <Eigen/Geometry>
#include <QImage>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/mapping/map_cells.hpp"
#include "core/motion/planar.hpp"
#include "gui/model/drive_readings.hpp"

namespace pilothouse::gui {

// What the robot says of the place that it knows, checked: every number finite unless its comment
// says otherwise, every text short and printable. Places are in the map's frame [m].

/// The map with pictures of it. Level 0 has a pixel a cell, each further level half as many a side:
/// a pixel shows the gravest of its cells, so that a thin wall never vanishes when seen from afar.
/// North is up: pixel (column, row) of level 0 is the cell (column, size_y - 1 - row).
struct MapPicture {
  MapCells cells;
  std::vector<QImage> levels;  ///< ARGB32_Premultiplied, transparent where unknown
  std::string frame;
  std::uint32_t version = 0;

  double width() const { return cells.size_x * cells.cell_size; }   ///< [m]
  double height() const { return cells.size_y * cells.cell_size; }  ///< [m]
};

/// Where the robot is in the map.
struct PoseReading {
  Pose2 pose;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of x, y [m^2] and heading [rad^2]
  bool spread_known = false;                             ///< the covariance was told
  std::string frame;
  double at = -1e9;  ///< steady arrival [s]
};

/// In the order of NavigationState.state.
enum class NavigationPhase : std::uint8_t {
  kIdle,
  kPlanning,
  kDriving,
  kWaiting,
  kLooking,
  kBacking,
  kPausing,
  kReached,
  kFailed,
};

struct NavigationReading {
  NavigationPhase phase = NavigationPhase::kIdle;
  std::string text;
  Eigen::Vector2d goal = Eigen::Vector2d::Zero();
  std::optional<double> heading;  ///< none: any [rad]
  std::uint32_t point = 0, points = 0, plans = 0;
  double distance_left = kUnknown;  ///< [m]; NaN: unknown
  double time_left = kUnknown;      ///< [s]; NaN: unknown
  std::optional<Eigen::Vector2d> nearest;
};

/// In the order of TaskState.state.
enum class TaskPhase : std::uint8_t { kIdle, kRunning, kPaused, kDone, kCancelled, kFailed };

struct TaskReading {
  std::uint32_t id = 0;
  std::string behaviour;
  TaskPhase phase = TaskPhase::kIdle;
  std::string text;
  std::vector<std::string> waiting;
  std::string refused;
};

/// A way over the map.
struct PathReading {
  std::vector<Eigen::Vector2d> points;
  std::string frame;
  double length = 0.0;  ///< [m]
};

}  // namespace pilothouse::gui
