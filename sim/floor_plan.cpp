#include "sim/floor_plan.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace pilothouse::sim {
namespace {

constexpr double kCell = 0.1;  // of the search [m]
constexpr double kStep = 0.02;
constexpr double kLeastRoute = 1.0;
constexpr double kFar = std::numeric_limits<double>::infinity();

}  // namespace

void FloorPlan::addRectangle(const Pose2& middle, const Eigen::Vector2d& size) {
  rectangles_.push_back({middle, 0.5 * size});
}

void FloorPlan::addDisc(const Eigen::Vector2d& middle, double radius) {
  discs_.push_back({middle, radius});
}

double FloorPlan::clearance(const Eigen::Vector2d& point) const {
  double least = std::min(point.minCoeff(), (size_ - point).minCoeff());
  for (const Rectangle& r : rectangles_) {
    const Eigen::Vector2d beyond = r.middle.toBase(point).cwiseAbs() - r.half;
    const double outside = beyond.cwiseMax(0.0).norm();
    least = std::min(least, outside > 0.0 ? outside : beyond.maxCoeff());
  }
  for (const Disc& d : discs_) least = std::min(least, (point - d.middle).norm() - d.radius);
  return least;
}

bool FloorPlan::isFree(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double least) const {
  const int steps = 1 + static_cast<int>((to - from).norm() / kStep);
  for (int i = 0; i <= steps; ++i) {
    const double share = static_cast<double>(i) / steps;
    if (clearance(from + share * (to - from)) < least) return false;
  }
  return true;
}

std::optional<std::vector<Eigen::Vector2d>> FloorPlan::routeFrom(const Eigen::Vector2d& start,
                                                                 double least,
                                                                 double length) const {
  const int columns = static_cast<int>(size_.x() / kCell),
            rows = static_cast<int>(size_.y() / kCell);
  const auto at = [&](int cell) {
    return Eigen::Vector2d((cell % columns + 0.5) * kCell, (cell / columns + 0.5) * kCell);
  };
  // Half a diagonal more than asked for, so that what lies between two free cells is free.
  std::vector<double> distance(static_cast<std::size_t>(columns * rows), -1.0);
  for (int cell = 0; cell < columns * rows; ++cell) {
    if (clearance(at(cell)) >= least + 0.75 * kCell)
      distance[static_cast<std::size_t>(cell)] = kFar;
  }
  const auto cellOf = [&](const Eigen::Vector2d& p) {
    return static_cast<int>(p.x() / kCell) + columns * static_cast<int>(p.y() / kCell);
  };
  if ((start.array() < 0.0).any() || (start.array() >= size_.array() - kCell).any())
    return std::nullopt;
  const int first = cellOf(start);
  if (distance[static_cast<std::size_t>(first)] < 0.0) return std::nullopt;

  std::vector<int> from(distance.size(), -1);
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  distance[static_cast<std::size_t>(first)] = 0.0;
  open.emplace(0.0, first);
  int best = first;
  while (!open.empty()) {
    const auto [here_distance, here] = open.top();
    open.pop();
    if (here_distance > distance[static_cast<std::size_t>(here)]) continue;
    if (std::abs(here_distance - length) <
        std::abs(distance[static_cast<std::size_t>(best)] - length))
      best = here;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const int x = here % columns + dx, y = here / columns + dy;
        if (x < 0 || y < 0 || x >= columns || y >= rows) continue;
        const auto next = static_cast<std::size_t>(x + columns * y);
        const double far = here_distance + kCell * std::hypot(dx, dy);
        if (!(far < distance[next])) continue;
        distance[next] = far;
        from[next] = here;
        open.emplace(far, static_cast<int>(next));
      }
    }
  }
  if (distance[static_cast<std::size_t>(best)] < kLeastRoute) return std::nullopt;
  std::vector<Eigen::Vector2d> way;
  for (int cell = best; cell >= 0; cell = from[static_cast<std::size_t>(cell)])
    way.push_back(at(cell));
  std::reverse(way.begin(), way.end());
  return pulled(way, least);
}

std::vector<Eigen::Vector2d> FloorPlan::pulled(const std::vector<Eigen::Vector2d>& way,
                                               double least) const {
  std::vector<Eigen::Vector2d> route = {way.front()};
  for (std::size_t at = 0; at + 1 < way.size();) {
    std::size_t next = at + 1;
    for (std::size_t ahead = at + 2; ahead < way.size(); ++ahead)
      if (isFree(way[at], way[ahead], least)) next = ahead;
    route.push_back(way[next]);
    at = next;
  }
  return route;
}

}  // namespace pilothouse::sim
