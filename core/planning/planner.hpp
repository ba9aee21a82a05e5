#pragma once

#include <optional>
#include <vector>

#include "core/motion/base_parameters.hpp"
#include "core/planning/hidden_sides.hpp"
#include "core/planning/marked_map.hpp"
#include "core/planning/outline_walk.hpp"
#include "core/planning/path_smoother.hpp"
#include "core/planning/plan_ends.hpp"
#include "core/planning/reach.hpp"

namespace pilothouse {

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

  using Mark = MapMark;
  /// A new map; marks stay. @throws std::invalid_argument naming what is wrong with its size.
  void setMap(const MapCells& map);
  bool hasMap() const { return map().size_x > 0; }
  const MapCells& map() const { return map_.cells(); }  ///< marks included
  /// Replaces all earlier marks. @return whether anything changed.
  bool mark(const std::vector<Mark>& marks) { return map_.mark(marks, field_); }
  /// Seen from `pose`: what may stand behind is marked too, until the floor there is seen.
  bool markSeen(std::vector<Mark> marks, const Pose2& pose);
  /// Whether anything is marked that is only hidden; whether such is to be marked at all.
  bool hides() const;
  void ignoreHidden(bool ignored);
  const std::vector<Mark>& marks() const { return map_.marks(); }
  /// Another number whenever map or marks have changed.
  std::uint32_t revision() const { return map_.revision(); }

  Plan plan(const PlanRequest& request);
  /// As if these were all the marks there are.
  Plan planAmong(const std::vector<Mark>& marks, const PlanRequest& request);
  /// Whether a way is still free: the bare outline touches nothing on it. @param poses map frame.
  bool free(const std::vector<Pose2>& poses) const { return touchesNothing(bare_, poses); }
  /// And with half of the clearance round it.
  bool roomy(const std::vector<Pose2>& poses) const { return touchesNothing(check_, poses); }

  const CostField& field() const { return field_; }
  const FootprintCheck& check() const { return check_; }
  const PlanningParameters& parameters() const { return parameters_; }

 private:
  NoWay search(const PlanRequest& request, const PlanEnds& ends, Plan& plan);
  void coverGoal(const Eigen::Vector2d& goal);
  void openRound(const Pose2& start);
  NoWay parts(const PlanEnds& ends);
  void fail(NoWay why, const PlanRequest& request, const PlanEnds& ends, Plan& plan);
  void lay(const PlanRequest& request, const PlanEnds& ends, Plan& plan);
  std::optional<Pose2> touchOf(const PlanRequest& request, Plan& plan);
  bool tighten(const Eigen::Vector2d& touch);
  void close(const Pose2& touch, int attempt, const PlanEnds& ends);
  void restore();
  void putPoses(const PlanRequest& request, Plan& plan) const;
  bool touchesNothing(const FootprintCheck& check, const std::vector<Pose2>& poses) const;
  bool turns() const;

  PlanningParameters parameters_;
  BaseKind base_;
  FootprintCheck check_, bare_;  ///< with and without something to spare
  CostField field_;
  MarkedMap map_;
  HiddenSides hidden_;
  bool ignores_hidden_ = false;
  GridSearch search_;
  Reach reach_, goal_reach_;  ///< of start and goal, where there is no way
  PathSmoother smoother_;
  std::vector<Cell> cells_;
  std::vector<GridPoint> grid_points_;
  std::vector<Eigen::Vector2d> points_;
  CellWindow altered_;  ///< cells closed and opened for a search
};

}  // namespace pilothouse
