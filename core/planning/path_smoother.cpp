#include "core/planning/path_smoother.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pilothouse {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr int kRounds = 6;
constexpr double kSlack = 1.0 + 1e-9;       // of sums that should be equal
constexpr double kWorthwhile = 1.0 - 1e-4;  // a cut must save so much
constexpr double kGraze = 1e-6;             // as much of a closed cell is a touched corner [cells]
constexpr double kShortest = 0.5;           // legs that are cut [cells]

}  // namespace

double straightCost(const CostField& field, const GridPoint& from, const GridPoint& to,
                    double limit) {
  const GridPoint way = to - from;
  const double length = way.norm();
  int x = static_cast<int>(std::floor(from.x())), y = static_cast<int>(std::floor(from.y()));
  const int end_x = static_cast<int>(std::floor(to.x()));
  const int end_y = static_cast<int>(std::floor(to.y()));
  const int step_x = way.x() > 0.0 ? 1 : -1, step_y = way.y() > 0.0 ? 1 : -1;
  // Shares of the way at which the next column and row begin, and from one to the next.
  const double per_x = way.x() == 0.0 ? kNever : std::abs(1.0 / way.x());
  const double per_y = way.y() == 0.0 ? kNever : std::abs(1.0 / way.y());
  double next_x =
      way.x() == 0.0 ? kNever : per_x * (step_x > 0 ? x + 1.0 - from.x() : from.x() - x);
  double next_y =
      way.y() == 0.0 ? kNever : per_y * (step_y > 0 ? y + 1.0 - from.y() : from.y() - y);
  const std::uint8_t* const weights = field.weights().data();
  const double most = limit * CostField::kPlain * kSlack;
  double cost = 0.0, at = 0.0;
  for (int left = std::abs(end_x - x) + std::abs(end_y - y);; --left) {
    if (x < 0 || y < 0 || x >= field.sizeX() || y >= field.sizeY()) return kNever;
    const int weight = weights[field.index(x, y)];
    const double until = left <= 0 ? 1.0 : std::max(at, std::min({next_x, next_y, 1.0}));
    const double within = (until - at) * length;
    if (weight == 0 && within > kGraze) return kNever;
    cost += within * weight;
    if (cost > most) return kNever;
    if (left <= 0) return cost / CostField::kPlain;
    at = until;
    const bool by_x = x != end_x && (y == end_y || next_x <= next_y);
    if (by_x) {
      x += step_x;
      next_x += per_x;
    } else {
      y += step_y;
      next_y += per_y;
    }
  }
}

/// From each point straight to the farthest point that this costs no more to.
void PathSmoother::pull(const CostField& field, std::vector<GridPoint>& points) {
  const std::size_t last = all_.size() - 1;
  const auto goes = [&](std::size_t from, std::size_t to) {
    return straightCost(field, all_[from], all_[to], costs_[to] - costs_[from]) < kNever;
  };
  points.push_back(all_.front());
  for (std::size_t from = 0; from < last;) {
    std::size_t good = from + 1, step = 2;
    while (good < last && goes(from, std::min(last, from + step))) {
      good = std::min(last, from + step);
      step *= 2;
    }
    std::size_t bad = std::min(last + 1, from + step);
    while (bad > good + 1) {
      const std::size_t middle = good + (bad - good) / 2;
      (goes(from, middle) ? good : bad) = middle;
    }
    points.push_back(all_[good]);
    from = good;
  }
}

/// Each corner is replaced by two a little before and behind it, as far off as it pays.
bool PathSmoother::cutCorners(const CostField& field, std::vector<GridPoint>& points) {
  bool changed = false;
  next_.clear();
  next_.push_back(points.front());
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const GridPoint before = next_.back(), corner = points[i], after = points[i + 1];
    const double in = (corner - before).norm(), out = (after - corner).norm();
    bool cut = false;
    for (double share = 1.0; share > 0.1 && !cut && std::min(in, out) > kShortest; share *= 0.5) {
      const double off = share * std::min(in, out);
      const GridPoint a = corner + off / in * (before - corner);
      const GridPoint b = corner + off / out * (after - corner);
      const double old =
          straightCost(field, a, corner, kNever) + straightCost(field, corner, b, kNever);
      if (!(straightCost(field, a, b, kWorthwhile * old) < kNever)) continue;
      if ((a - before).norm() > 1e-6) next_.push_back(a);
      if ((after - b).norm() > 1e-6) next_.push_back(b);
      cut = changed = true;
    }
    if (!cut) next_.push_back(corner);
  }
  if (points.size() > 1) next_.push_back(points.back());
  points.swap(next_);
  return changed;
}

void PathSmoother::dropNeedless(const CostField& field, std::vector<GridPoint>& points) {
  next_.clear();
  next_.push_back(points.front());
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const double old = straightCost(field, next_.back(), points[i], kNever) +
                       straightCost(field, points[i], points[i + 1], kNever);
    const double straight = straightCost(field, next_.back(), points[i + 1], old / kWorthwhile);
    if (!(straight < kNever)) next_.push_back(points[i]);
  }
  if (points.size() > 1) next_.push_back(points.back());
  points.swap(next_);
}

void PathSmoother::smooth(const CostField& field, const std::vector<Cell>& way,
                          std::vector<GridPoint>& points) {
  all_.clear();
  costs_.clear();
  points.clear();
  for (const Cell& cell : way) {
    const GridPoint place(cell.x + 0.5, cell.y + 0.5);
    const double step =
        all_.empty()
            ? 0.0
            : 0.5 * (place - all_.back()).norm() *
                  (field.weight(cell.x, cell.y) + field.weight(static_cast<int>(all_.back().x()),
                                                               static_cast<int>(all_.back().y()))) /
                  CostField::kPlain;
    costs_.push_back(costs_.empty() ? 0.0 : costs_.back() + step);
    all_.push_back(place);
  }
  pull(field, points);
  for (int round = 0; round < kRounds && cutCorners(field, points); ++round) {
    dropNeedless(field, points);
  }
}

}  // namespace pilothouse
