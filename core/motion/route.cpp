#include "core/motion/route.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pilothouse {
namespace {

using Eigen::Vector2d;

constexpr double kSame = 1e-3;  // points nearer than this are one [m]

double cross(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}
Vector2d leftOf(const Vector2d& direction) {
  return {-direction.y(), direction.x()};
}

/// One point of the route with the arc that rounds it.
struct Corner {
  Vector2d point;
  std::size_t index;     ///< among the points given
  double turn = 0.0;     ///< of the direction, counter-clockwise [rad]
  double tangent = 0.0;  ///< the arc begins and ends this far from the point [m]; 0: sharp
  double radius = 0.0;   ///< [m]
};

std::vector<Corner> apart(const std::vector<Vector2d>& points) {
  std::vector<Corner> corners;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (corners.empty() || (points[i] - corners.back().point).norm() > kSame) {
      corners.push_back({points[i], i});
    }
  }
  return corners;
}

/// An arc of radius r that touches both legs begins r tan(turn / 2) before the corner and passes it
/// at r (1 / cos(turn / 2) - 1).
void roundOff(Corner& corner, const Vector2d& before, const Vector2d& after,
              const CornerParameters& parameters) {
  const Vector2d in = corner.point - before, out = after - corner.point;
  corner.turn = std::atan2(cross(in, out), in.dot(out));
  const double half = 0.5 * std::abs(corner.turn);
  if (half < 1e-6) return;
  const double tangent = std::tan(half), cut = 1.0 / std::cos(half) - 1.0;
  double radius = std::min(parameters.radius, 0.5 * std::min(in.norm(), out.norm()) / tangent);
  if (cut > 0.0) radius = std::min(radius, parameters.max_cut / cut);
  if (!(radius >= Route::kTightest)) return;
  corner.radius = radius;
  corner.tangent = radius * tangent;
}

}  // namespace

Route::Route(const std::vector<Vector2d>& points, const CornerParameters& parameters,
             std::size_t loop_from) {
  std::vector<Corner> corners = apart(points);
  if (corners.size() < 2) return;
  // A loop is laid out as its lead-in, one round, and the first leg once more; from the middle of
  // that leg it goes back to the middle of the same leg a round before, where the ways are alike.
  const auto first = std::find_if(corners.begin(), corners.end(),
                                  [&](const Corner& c) { return c.index >= loop_from; });
  const auto loop_corner = static_cast<std::size_t>(first - corners.begin());
  if (loop_from != kNoLoop && corners.size() - loop_corner >= 2) {
    const Corner begin = corners[loop_corner], second = corners[loop_corner + 1];
    if ((corners.back().point - begin.point).norm() > kSame) corners.push_back(begin);
    corners.push_back(second);
    loop_ = true;
  }
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    roundOff(corners[i], corners[i - 1].point, corners[i + 1].point, parameters);
  }
  pen_ = corners.front().point;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const Corner& corner = corners[i];
    const Vector2d leg = corner.point - corners[i - 1].point;
    const Vector2d direction = leg.normalized();
    if (loop_ && (i == loop_corner + 1 || i + 1 == corners.size())) {
      const Vector2d middle = corner.point - 0.5 * leg;
      append(middle, 0.0, (middle - pen_).norm(), direction, corner.index);
      if (i + 1 == corners.size()) break;
      loop_begin_ = length_;
      loop_piece_ = pieces_.size();
    }
    const Vector2d before = corner.point - corner.tangent * direction;
    append(before, 0.0, (before - pen_).dot(direction), direction, corner.index);
    const bool last = i + 1 == corners.size();
    if (last) break;
    if (corner.radius > 0.0) {
      const Vector2d out = (corners[i + 1].point - corner.point).normalized();
      append(corner.point + corner.tangent * out, std::copysign(1.0 / corner.radius, corner.turn),
             corner.radius * std::abs(corner.turn), direction, corner.index);
    } else {
      // A hardly noticeable turn needs neither an arc nor a stop.
      pieces_.back().sharp_end = std::abs(corner.turn) > 0.02;
    }
  }
}

void Route::append(const Vector2d& to, double curvature, double length, const Vector2d& direction,
                   std::size_t target) {
  // Pieces of no length are kept where they end sharply: they carry that.
  pieces_.push_back({length_, std::max(0.0, length), pen_, direction, curvature, target, false});
  length_ += std::max(0.0, length);
  pen_ = to;
}

Route::At Route::find(double way) const {
  double offset = 0.0;
  if (loop_ && way > length_) {
    offset = std::floor((way - loop_begin_) / round()) * round();
  }
  const double folded = way - offset;
  const auto after =
      std::upper_bound(pieces_.begin(), pieces_.end(), folded,
                       [](double value, const Piece& piece) { return value < piece.start; });
  const auto index = after == pieces_.begin() ? 0 : after - pieces_.begin() - 1;
  return {static_cast<std::size_t>(index), offset};
}

bool Route::next(At& at) const {
  if (++at.piece < pieces_.size()) return true;
  if (!loop_) return false;
  at.piece = loop_piece_;
  at.offset += round();
  return true;
}

Route::Place Route::along(const Piece& piece, double way) {
  const double s = std::clamp(way, 0.0, piece.length);
  if (piece.curvature == 0.0) return {piece.begin + s * piece.direction, piece.direction, 0.0};
  const double angle = piece.curvature * s;
  const Vector2d left = leftOf(piece.direction);
  return {piece.begin + std::sin(angle) / piece.curvature * piece.direction +
              (1.0 - std::cos(angle)) / piece.curvature * left,
          std::cos(angle) * piece.direction + std::sin(angle) * left, piece.curvature};
}

Route::Place Route::at(double way) const {
  if (empty()) return {pen_, {1.0, 0.0}, 0.0};
  const At at = find(way);
  const Piece& piece = pieces_[at.piece];
  return along(piece, way - at.offset - piece.start);
}

/// @param from @param to within the piece [m].
Route::Foot Route::nearestOn(const Piece& piece, const Vector2d& point, double from, double to) {
  double best = from;
  if (piece.curvature == 0.0) {
    best = std::clamp((point - piece.begin).dot(piece.direction), from, to);
  } else {
    const Vector2d centre = piece.begin + leftOf(piece.direction) / piece.curvature;
    const Vector2d spoke = piece.begin - centre, towards = point - centre;
    const double angle = std::atan2(cross(spoke, towards), spoke.dot(towards));
    const double foot = angle / piece.curvature;
    const double gap_from = (along(piece, from).position - point).norm();
    const double gap_to = (along(piece, to).position - point).norm();
    best = gap_from <= gap_to ? from : to;
    if (foot >= from && foot <= to) best = foot;
  }
  return {best, (along(piece, best).position - point).norm()};
}

Route::Foot Route::nearest(const Vector2d& point, double from, double to) const {
  Foot best{from, std::numeric_limits<double>::infinity()};
  if (empty()) return {from, (pen_ - point).norm()};
  At at = find(from);
  do {
    const Piece& piece = pieces_[at.piece];
    const double start = piece.start + at.offset;
    if (start > to) break;
    const double low = std::clamp(from - start, 0.0, piece.length);
    const double high = std::clamp(to - start, low, piece.length);
    const Foot foot = nearestOn(piece, point, low, high);
    if (foot.distance < best.distance - 1e-9) best = {start + foot.way, foot.distance};
  } while (next(at));
  return best;
}

double Route::stopAfter(double way) const {
  if (empty()) return 0.0;
  At at = find(way);
  // On a loop one round more than the rest of this one says it all.
  for (std::size_t i = 0; i <= 2 * pieces_.size(); ++i) {
    const Piece& piece = pieces_[at.piece];
    const double end = piece.start + piece.length + at.offset;
    if (piece.sharp_end && end >= way) return end;
    if (!next(at)) return length_;
  }
  return std::numeric_limits<double>::infinity();
}

std::size_t Route::target(double way) const {
  return empty() ? 0 : pieces_[find(way).piece].target;
}

}  // namespace pilothouse
