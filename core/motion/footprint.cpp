#include "core/motion/footprint.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <tuple>

namespace pilothouse {
namespace {

using Eigen::Vector2d;

double cross(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Convex hull, counter-clockwise, without corners on a straight edge (Andrew, 1979).
std::vector<Vector2d> hullOf(std::vector<Vector2d> points) {
  std::sort(points.begin(), points.end(), [](const Vector2d& a, const Vector2d& b) {
    return std::make_tuple(a.x(), a.y()) < std::make_tuple(b.x(), b.y());
  });
  std::vector<Vector2d> hull;
  const auto add = [&hull](const Vector2d& p, std::size_t least) {
    while (hull.size() >= least + 2 &&
           cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 1e-12) {
      hull.pop_back();
    }
    hull.push_back(p);
  };
  for (const auto& p : points) add(p, 0);
  const std::size_t lower = hull.size() - 1;
  for (auto p = points.rbegin() + 1; p != points.rend(); ++p) add(*p, lower);
  hull.pop_back();
  return hull;
}

double distanceToEdge(const Vector2d& p, const Footprint::Edge& edge) {
  const Vector2d along = edge.to - edge.from;
  const double share = std::clamp(along.dot(p - edge.from) / along.squaredNorm(), 0.0, 1.0);
  return (p - edge.from - share * along).norm();
}

}  // namespace

Footprint::Footprint(const std::vector<Vector2d>& corners) {
  for (const auto& corner : corners) {
    if (!corner.allFinite()) throw std::invalid_argument("footprint: a corner is not finite");
  }
  if (corners.size() >= 3) corners_ = hullOf(corners);
  if (corners_.size() < 3) {
    throw std::invalid_argument("footprint: " + std::to_string(corners.size()) +
                                " corners, expected at least 3 that are not on one line");
  }
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Vector2d& from = corners_[i];
    const Vector2d& to = corners_[(i + 1) % corners_.size()];
    const Vector2d normal = Vector2d(to.y() - from.y(), from.x() - to.x()).normalized();
    edges_.push_back({normal, normal.dot(from), from, to});
  }
}

double Footprint::farthestFrom(const Vector2d& point) const {
  double farthest = 0.0;
  for (const auto& corner : corners_) farthest = std::max(farthest, (corner - point).norm());
  return farthest;
}

double Footprint::distanceTo(const Vector2d& point) const {
  double nearest = std::numeric_limits<double>::infinity();
  bool within = true;
  for (const auto& edge : edges_) {
    within = within && edge.normal.dot(point) <= edge.offset;
    nearest = std::min(nearest, distanceToEdge(point, edge));
  }
  return within ? -nearest : nearest;
}

}  // namespace pilothouse
