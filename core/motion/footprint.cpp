#include "core/motion/footprint.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "core/motion/convex_hull.hpp"

namespace pilothouse {
namespace {

using Eigen::Vector2d;

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
  if (corners.size() >= 3) corners_ = convexHull(corners);
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
