#include "bench/shortest_way.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pilothouse::bench {
namespace {

using Eigen::Vector2d;

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kExact = 1e-9;
constexpr double kShort = 0.1;  // shorter edges are not asked for their direction [m]
constexpr double kStep = 0.03;  // of a disc that is pushed [m]

/// A point that ways may bend at, and the direction from the corner that it lies round; zero for
/// the ends.
struct Node {
  Vector2d place;
  Vector2d outward{0.0, 0.0};
};

class Graph {
 public:
  Graph(const std::vector<ConvexShape>& shapes, double radius, const Vector2d& start,
        const Vector2d& goal)
      : shapes_(shapes), near_(radius * std::cos(kCornerStep) - kExact) {
    nodes_ = {{start}, {goal}};
    for (const ConvexShape& shape : shapes) addArcs(shape, radius);
  }

  double length() const {
    std::vector<double> lengths(nodes_.size(), kInfinite);
    std::vector<char> done(nodes_.size(), 0);
    if (!free(nodes_[0].place, nodes_[0].place) || !free(nodes_[1].place, nodes_[1].place))
      return kInfinite;
    lengths[0] = 0.0;
    for (std::size_t at = 0; at != nodes_.size(); at = nearest(lengths, done)) {
      if (at == 1) return lengths[1];
      done[at] = 1;
      for (std::size_t i = 1; i < nodes_.size(); ++i) {
        const double length = lengths[at] + (nodes_[i].place - nodes_[at].place).norm();
        if (done[i] == 0 && length < lengths[i] && joined(nodes_[at], nodes_[i])) {
          lengths[i] = length;
        }
      }
    }
    return kInfinite;
  }

 private:
  /// The arc round each corner, from the one side's normal to the other's.
  void addArcs(const ConvexShape& shape, double radius) {
    const auto& corners = shape.corners();
    const std::size_t n = corners.size();
    const auto normal = [&](std::size_t i) {
      const Vector2d side = corners[(i + 1) % n] - corners[i % n];
      return std::atan2(-side.x(), side.y());
    };
    for (std::size_t i = 0; i < n; ++i) {
      const double from = n > 1 ? normal(i + n - 1) : 0.0;
      double turn = n > 1 ? normal(i) - from : 2.0 * M_PI;
      while (turn < 0.0) turn += 2.0 * M_PI;
      const int steps = std::max(1, static_cast<int>(std::ceil(turn / kCornerStep)));
      for (int k = 0; k <= steps; ++k) {
        const double angle = from + turn * k / steps;
        const Vector2d outward(std::cos(angle), std::sin(angle));
        const Vector2d place = corners[i] + radius * outward;
        if (free(place, place)) nodes_.push_back({place, outward});
      }
    }
  }
  /// The node that is not done whose way, and the straight line from it, is shortest; their number:
  /// none.
  std::size_t nearest(const std::vector<double>& lengths, const std::vector<char>& done) const {
    std::size_t best = nodes_.size();
    double least = kInfinite;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const double estimate = lengths[i] + (nodes_[i].place - nodes_[1].place).norm();
      if (done[i] != 0 || estimate >= least) continue;
      best = i;
      least = estimate;
    }
    return best;
  }
  bool free(const Vector2d& a, const Vector2d& b) const {
    const Vector2d low = a.cwiseMin(b).array() - near_, high = a.cwiseMax(b).array() + near_;
    return std::none_of(shapes_.begin(), shapes_.end(), [&](const ConvexShape& shape) {
      return shape.bounds().intersects(Eigen::AlignedBox2d(low, high)) &&
             shape.distanceTo(a, b) < near_;
    });
  }
  /// A shortest way leaves arcs along them, or all but.
  bool joined(const Node& a, const Node& b) const {
    const Vector2d way = b.place - a.place;
    const double aside = way.norm() * std::sin(2.5 * kCornerStep);
    if (way.norm() > kShort &&
        (std::abs(way.dot(a.outward)) > aside || std::abs(way.dot(b.outward)) > aside)) {
      return false;
    }
    return free(a.place, b.place);
  }

  const std::vector<ConvexShape>& shapes_;
  double near_;
  std::vector<Node> nodes_;
};

}  // namespace

double shortestWay(const std::vector<ConvexShape>& shapes, double radius, const Vector2d& start,
                   const Vector2d& goal) {
  return Graph(shapes, radius, start, goal).length();
}

DiscReach::DiscReach(const std::vector<ConvexShape>& shapes, double radius, const Vector2d& start)
    : start_(start) {
  Eigen::AlignedBox2d bounds(start);
  for (const ConvexShape& shape : shapes) bounds.extend(shape.bounds());
  const Vector2d low = (bounds.min() - start) / kStep, high = (bounds.max() - start) / kStep;
  min_x_ = static_cast<int>(std::floor(low.x()));
  min_y_ = static_cast<int>(std::floor(low.y()));
  size_x_ = static_cast<int>(std::ceil(high.x())) - min_x_ + 1;
  size_y_ = static_cast<int>(std::ceil(high.y())) - min_y_ + 1;
  reached_.assign(index(0, size_y_), 0);
  std::vector<char> seen(reached_.size(), 0);
  std::vector<std::pair<int, int>> waiting = {{-min_x_, -min_y_}};
  while (!waiting.empty()) {
    const auto [x, y] = waiting.back();
    waiting.pop_back();
    if (x < 0 || y < 0 || x >= size_x_ || y >= size_y_ || seen[index(x, y)] != 0) continue;
    seen[index(x, y)] = 1;
    const Vector2d place = start_ + kStep * Vector2d(x + min_x_, y + min_y_);
    const bool fits = std::none_of(shapes.begin(), shapes.end(), [&](const ConvexShape& shape) {
      return shape.bounds().exteriorDistance(place) < radius && shape.distanceTo(place) < radius;
    });
    if (!fits) continue;
    reached_[index(x, y)] = 1;
    for (int v = y - 1; v <= y + 1; ++v) {
      for (int u = x - 1; u <= x + 1; ++u) waiting.emplace_back(u, v);
    }
  }
}

bool DiscReach::reaches(const Vector2d& place) const {
  const int x = static_cast<int>(std::lround((place.x() - start_.x()) / kStep)) - min_x_;
  const int y = static_cast<int>(std::lround((place.y() - start_.y()) / kStep)) - min_y_;
  return x >= 0 && y >= 0 && x < size_x_ && y < size_y_ && reached_[index(x, y)] != 0;
}

}  // namespace pilothouse::bench
