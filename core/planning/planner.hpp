#pragma once

#include <optional>
#include <vector>

#include "core/motion/base_parameters.hpp"
#include "core/planning/footprint_check.hpp"
#include "core/planning/grid_search.hpp"
#include "core/planning/no_way.hpp"
#include "core/planning/path_smoother.hpp"

namespace pilothouse {

struct PlanRequest {
  Pose2 start;                     ///< map frame
  Eigen::Vector2d goal{0.0, 0.0};  ///< map frame [m]
  std::optional<double> heading;   ///< at the goal; none: as it comes [rad]
};

struct Plan {
  NoWay why = NoWay::kNone;  ///< why there is none
  /// From the start to the goal, map frame. Headings: into the way that follows, or the start's
  /// where the base keeps it; the last is the one asked for, if any.
  std::vector<Pose2> poses;
  double length = 0.0;  ///< [m]
  double cost = 0.0;    ///< [m], of plain floor that would cost as much
  /// Where there is no way: the place nearest to the goal that can be reached [m], if any.
  std::optional<Eigen::Vector2d> nearest;
  std::size_t expanded = 0;  ///< cells that the search took up

  explicit operator bool() const { return why == NoWay::kNone; }
};

/// Shortest safe path over a map for the robot's footprint: the grid's cheapest way for a circle
/// within the footprint, pulled straight, rounded as the motion executor will round it, and then
/// looked at with the outline itself; places where that would touch are closed and the search
/// repeated.
class Planner {
 public:
  /// @throws std::invalid_argument listing every fault of the parameters.
  Planner(const PlanningParameters& parameters, const Footprint& footprint, BaseKind base);

  /// A new map; marks stay. @throws std::invalid_argument naming what is wrong with its size.
  void setMap(const MapCells& map);
  bool hasMap() const { return map_.size_x > 0; }
  const MapCells& map() const { return map_; }  ///< marks included
  /// Things seen now, whether the map has them or not: discs [m], map frame.
  struct Mark {
    Eigen::Vector2d place;
    double radius;
    MapCell kind = MapCell::kOccupied;
  };
  /// Replaces all earlier marks. What lies within a cell of something as grave in the map is that.
  /// @return whether anything changed.
  bool mark(const std::vector<Mark>& marks);
  /// Another number whenever map or marks have changed.
  std::uint32_t revision() const { return revision_; }

  Plan plan(const PlanRequest& request);
  /// As if there were no marks: whether what is in the way may go away again.
  Plan planWithoutMarks(const PlanRequest& request);
  /// Whether a way is still free: the bare outline touches nothing on it. @param poses map frame.
  bool free(const std::vector<Pose2>& poses) const;

  const CostField& field() const { return field_; }
  const FootprintCheck& check() const { return check_; }
  const PlanningParameters& parameters() const { return parameters_; }

 private:
  struct Ends {
    Cell start, goal;
    bool has_start = false;
    bool escaped = false;  ///< the start is not where the robot stands, but the nearest free cell
  };
  bool known(int x, int y, MapCell kind) const;
  void putMarks();
  NoWay findEnds(const PlanRequest& request, Ends& ends) const;
  std::optional<Cell> wayOut(const Pose2& start) const;
  NoWay judgeGoal(const PlanRequest& request, const Cell& goal) const;
  void fail(NoWay why, const PlanRequest& request, const Ends& ends, Plan& plan);
  void lay(const PlanRequest& request, const Ends& ends, Plan& plan);
  std::optional<Pose2> touchOf(const PlanRequest& request, Plan& plan);
  std::optional<Pose2> firstTouch(const FootprintCheck& check, const PlanRequest& request,
                                  const Route& route) const;
  bool tighten(const Eigen::Vector2d& touch);
  void close(const Pose2& touch, int attempt, const Ends& ends);
  void reopen();
  void putPoses(const PlanRequest& request, Plan& plan) const;
  bool turns() const;

  PlanningParameters parameters_;
  BaseKind base_;
  FootprintCheck check_, bare_;  ///< with and without something to spare
  CostField field_;
  MapCells clean_, map_;  ///< without and with marks
  std::vector<Mark> marks_;
  std::vector<std::size_t> marked_, marking_;  ///< cell * 8 + kind, rising
  std::uint32_t revision_ = 0;
  GridSearch search_;
  PathSmoother smoother_;
  std::vector<Cell> cells_;
  std::vector<GridPoint> grid_points_;
  std::vector<Eigen::Vector2d> points_;
  CellWindow closed_;
};

}  // namespace pilothouse
