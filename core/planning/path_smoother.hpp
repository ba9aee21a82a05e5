#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/planning/cost_field.hpp"
#include "core/planning/grid_search.hpp"

namespace pilothouse {

/// A place on a grid [cells]: cell (x, y) covers [x, x + 1) x [y, y + 1).
using GridPoint = Eigen::Vector2d;

/// Cost of going straight from one place to another: every cell's weight times the way within it,
/// exactly (the traversal of Amanatides and Woo 1987), in lengths of a cell at CostField::kPlain.
/// Infinite where the way is in a cell without weight; touching its corner is not. @param limit
/// [same]: beyond it, infinite too.
double straightCost(const CostField& field, const GridPoint& from, const GridPoint& to,
                    double limit);

/// Pulls a way of cells straight where that costs no more: first from each point to the farthest
/// that can be seen, then corner by corner, each cut off as far as it pays.
class PathSmoother {
 public:
  /// @param way neighbouring cells, at least one.
  /// @param points filled anew: from the middle of the first cell to that of the last.
  void smooth(const CostField& field, const std::vector<Cell>& way, std::vector<GridPoint>& points);

 private:
  void pull(const CostField& field, std::vector<GridPoint>& points);
  bool cutCorners(const CostField& field, std::vector<GridPoint>& points);
  void dropNeedless(const CostField& field, std::vector<GridPoint>& points);

  std::vector<GridPoint> all_, next_;
  std::vector<double> costs_;  ///< along the way of cells
};

}  // namespace pilothouse
