#include "bench/convex_shape.hpp"

#include <algorithm>
#include <utility>

#include "core/motion/convex_hull.hpp"

namespace pilothouse::bench {
namespace {

using Eigen::Vector2d;

double cross(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

double toSegment(const Vector2d& point, const Vector2d& a, const Vector2d& b) {
  const Vector2d along = b - a;
  const double square = along.squaredNorm();
  const double share = square > 0.0 ? std::clamp(along.dot(point - a) / square, 0.0, 1.0) : 0.0;
  return (a + share * along - point).norm();
}

bool crossing(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
  const double from = cross(b - a, c - a), to = cross(b - a, d - a);
  const double left = cross(d - c, a - c), right = cross(d - c, b - c);
  return ((from > 0.0) != (to > 0.0)) && ((left > 0.0) != (right > 0.0));
}

}  // namespace

ConvexShape::ConvexShape(std::vector<Vector2d> points) : corners_(convexHull(std::move(points))) {
  for (const Vector2d& corner : corners_) bounds_.extend(corner);
}

bool ConvexShape::contains(const Vector2d& point) const {
  if (corners_.size() < 3) return false;
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Vector2d& from = corners_[i];
    if (cross(corners_[(i + 1) % corners_.size()] - from, point - from) < 0.0) return false;
  }
  return true;
}

double ConvexShape::distanceTo(const Vector2d& a, const Vector2d& b) const {
  if (contains(a) || contains(b)) return 0.0;
  double least = HUGE_VAL;
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Vector2d &from = corners_[i], &to = corners_[(i + 1) % corners_.size()];
    if (crossing(a, b, from, to)) return 0.0;
    least =
        std::min({least, toSegment(from, a, b), toSegment(a, from, to), toSegment(b, from, to)});
  }
  return least;
}

}  // namespace pilothouse::bench
