#include "sim/footprint_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pilothouse::sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kTouching = 1e-6;  // [m]

/// Up to five corners after a cut.
struct Polygon {
  std::array<Vector3d, 5> corners;
  std::size_t count = 0;
  void add(const Vector3d& corner) {
    if (count < corners.size()) corners[count++] = corner;
  }
};

/// The part with sign * (z - height) >= 0 (Sutherland and Hodgman, 1974).
Polygon cut(const Polygon& polygon, double height, double sign) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const Vector3d& a = polygon.corners[i];
    const Vector3d& b = polygon.corners[(i + 1) % polygon.count];
    const double above_a = sign * (a.z() - height), above_b = sign * (b.z() - height);
    if (above_a >= 0.0) kept.add(a);
    if (above_a * above_b < 0.0) kept.add(a + above_a / (above_a - above_b) * (b - a));
  }
  return kept;
}

double distanceToSegment(const Vector2d& p, const Vector2d& from, const Vector2d& to) {
  const Vector2d along = to - from;
  const double length2 = along.squaredNorm();
  const double share = length2 > 0.0 ? std::clamp(along.dot(p - from) / length2, 0.0, 1.0) : 0.0;
  return (p - from - share * along).norm();
}

/// Gap along a unit axis between the outline (lower side) and the slice; negative: they overlap.
double gapAlong(const Vector2d& axis, const Footprint& footprint, const Slice& slice) {
  double high = -std::numeric_limits<double>::infinity(), low = -high;
  for (const auto& corner : footprint.corners()) high = std::max(high, axis.dot(corner));
  for (std::size_t i = 0; i < slice.count; ++i) low = std::min(low, axis.dot(slice.corners[i]));
  return low - high;
}

/// The largest gap along any axis that can separate the two.
double widestGap(const Footprint& footprint, const Slice& slice) {
  double widest = -std::numeric_limits<double>::infinity();
  for (const auto& edge : footprint.edges()) {
    double low = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < slice.count; ++i) {
      low = std::min(low, edge.normal.dot(slice.corners[i]));
    }
    widest = std::max(widest, low - edge.offset);
  }
  for (std::size_t i = 0; i < slice.count; ++i) {
    const Vector2d along = slice.corners[(i + 1) % slice.count] - slice.corners[i];
    if (along.squaredNorm() < 1e-18) continue;
    const Vector2d axis = Vector2d(-along.y(), along.x()).normalized();
    widest =
        std::max({widest, gapAlong(axis, footprint, slice), gapAlong(-axis, footprint, slice)});
  }
  return widest;
}

}  // namespace

std::optional<Slice> sliceOf(const std::array<Vector3d, 3>& corners, double low, double high) {
  const auto [bottom, top] = std::minmax({corners[0].z(), corners[1].z(), corners[2].z()});
  if (top <= low + kTouching || bottom >= high - kTouching) return std::nullopt;
  Polygon polygon;
  for (const auto& corner : corners) polygon.add(corner);
  polygon = cut(cut(polygon, low, 1.0), high, -1.0);
  if (polygon.count < 2) return std::nullopt;
  Slice slice;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    slice.corners[slice.count++] = polygon.corners[i].head<2>();
  }
  return slice;
}

double separation(const Footprint& footprint, const Pose2& pose, const Slice& slice) {
  Slice seen = slice;
  for (std::size_t i = 0; i < seen.count; ++i) seen.corners[i] = pose.toBase(slice.corners[i]);
  const double gap = widestGap(footprint, seen);
  if (gap <= 0.0) return gap;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < seen.count; ++i) {
    nearest = std::min(nearest, footprint.distanceTo(seen.corners[i]));
    for (const auto& corner : footprint.corners()) {
      nearest = std::min(
          nearest, distanceToSegment(corner, seen.corners[i], seen.corners[(i + 1) % seen.count]));
    }
  }
  return nearest;
}

}  // namespace pilothouse::sim
