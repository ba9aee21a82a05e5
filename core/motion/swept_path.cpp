#include "core/motion/swept_path.hpp"

#include <algorithm>
#include <cmath>

namespace pilothouse {
namespace {

using Eigen::Vector2d;

constexpr double kTurn = 6.283185307179586;
constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kStraight = 1e-3;  // turning less than this [rad/m] is straight
constexpr double kMostTurn = 1.2;   // an arc is followed no farther [rad]: nobody drives circles
constexpr double kAtLeastBeside = 0.03;  // margin when turning in place [m]
constexpr double kOnEdge = 1e-9;         // [m]

double cross(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace

Corridor::Corridor(const Footprint& footprint, const Vector2d& direction, double margin)
    : direction_(direction.normalized()), half_width_(0.0), margin_(margin) {
  for (const auto& corner : footprint.corners()) {
    const Vector2d beside = -corner + corner.dot(direction_) * direction_;  // a is the origin
    half_width_ = std::max(half_width_, beside.norm());
  }
}

Relevance Corridor::classify(const Vector2d& point, double radius) const {
  const double ahead = point.dot(direction_);
  if (!(ahead + radius > 0.0)) return Relevance::kOther;
  const double beside = (-point + ahead * direction_).norm() - radius;
  if (beside <= half_width_) return Relevance::kInTheWay;
  return beside <= half_width_ + margin_ ? Relevance::kPotential : Relevance::kOther;
}

double SweptPath::speedOf(const Footprint& footprint, const Twist2& twist) {
  double fastest = 0.0;
  for (const auto& p : footprint.corners()) {
    fastest = std::max(fastest, std::hypot(twist.vx - twist.w * p.y(), twist.vy + twist.w * p.x()));
  }
  return fastest;
}

SweptPath::SweptPath(const Footprint& footprint, const Twist2& twist, double margin,
                     double look_ahead)
    : footprint_(footprint), look_ahead_(look_ahead) {
  const double speed = speedOf(footprint, twist);
  moves_ = speed > 0.0 && std::isfinite(speed);
  if (moves_) unit_ = (1.0 / speed) * twist;
  // What is beside cannot be hit by turning in place: the margin is for going past things.
  margin_ = std::max(std::min(kAtLeastBeside, margin), margin * std::min(1.0, unit_.linear()));
  reach_ = footprint.farthestFrom(Vector2d::Zero());
  turns_ = std::abs(unit_.w) > kStraight;
  if (turns_) {
    layOutTurn();
  } else {
    layOutLine();
  }
}

void SweptPath::layOutLine() {
  if (moves_) direction_ = Vector2d(unit_.vx, unit_.vy).normalized();
  left_ = front_ = -kInfinite;
  right_ = rear_ = kInfinite;
  for (const auto& corner : footprint_.corners()) {
    left_ = std::max(left_, cross(direction_, corner));
    right_ = std::min(right_, cross(direction_, corner));
    front_ = std::max(front_, corner.dot(direction_));
    rear_ = std::min(rear_, corner.dot(direction_));
  }
}

void SweptPath::layOutTurn() {
  centre_ = Vector2d(-unit_.vy, unit_.vx) / unit_.w;
  look_ahead_ = std::min(look_ahead_, kMostTurn / std::abs(unit_.w));
  farthest_ = footprint_.farthestFrom(centre_);
  nearest_ = std::max(0.0, footprint_.distanceTo(centre_));
  const double sense = unit_.w > 0.0 ? 1.0 : -1.0;
  double first = -kInfinite, last = kInfinite;  // corners round the centre, from the base's origin
  const auto& edges = footprint_.edges();
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto& edge = edges[i];
    const double turn = edge.normal.dot(edges[(i + 1) % edges.size()].normal);
    mitre_ = std::max(mitre_, std::sqrt(2.0 / std::max(0.02, 1.0 + turn)));
    const Vector2d from = edge.from - centre_, to = edge.to - centre_;
    const Vector2d along = (to - from).normalized();
    const Vector2d foot = from - std::clamp(from.dot(along), -(to - from).norm(), 0.0) * along;
    turning_edges_.push_back({edge.offset - edge.normal.dot(centre_), edge.normal, foot.norm(),
                              std::max(from.norm(), to.norm())});
    const double angle = std::atan2(sense * cross(-centre_, from), -centre_.dot(from));
    if (angle > first) {
      first = angle;
      lead_ = from;
    }
    last = std::min(last, angle);
  }
  extent_ = first - last;
  const double most = look_ahead_ * std::abs(unit_.w);
  sector_ = Eigen::Rotation2Dd(sense * 0.5 * (most - extent_)) * lead_.normalized();
  sector_cos_ = std::cos(std::min(0.5 * kTurn, 0.5 * (most + extent_)));
}

// From the outline's rear end to where its lead is at the end of the look-ahead, and as much more
// as the outline is grown. Cosine falls no faster than its angle rises, and asin(x) <= pi / 2 x.
bool SweptPath::outOfSector(const Vector2d& arm, double from_centre, double inflation) const {
  const double grown = 0.25 * kTurn * mitre_ * inflation;
  return nearest_ > 0.0 && arm.dot(sector_) < from_centre * sector_cos_ - grown;
}

SweptPath::Contact SweptPath::meet(const Vector2d& point, double radius) const {
  if (!moves_) return {};
  return turns_ ? meetTurning(point, radius) : meetStraight(point, radius);
}

SweptPath::Contact SweptPath::meetStraight(const Vector2d& point, double radius) const {
  const double beside = cross(direction_, point);
  const double reach = radius + margin_;
  if (beside > left_ + reach || beside < right_ - reach) return {};
  const double ahead = point.dot(direction_);
  if (ahead < rear_ - radius || ahead > front_ + radius + look_ahead_) return {};
  if (beside <= left_ + radius && beside >= right_ - radius) {
    // The line from the point against the motion, cut with the outline grown by the radius.
    double enter = -kInfinite, leave = kInfinite;
    for (const auto& edge : footprint_.edges()) {
      const double along = edge.normal.dot(direction_);
      const double outside = edge.normal.dot(point) - edge.offset - radius;
      if (along > 1e-9) {
        enter = std::max(enter, outside / along);
      } else if (along < -1e-9) {
        leave = std::min(leave, outside / along);
      }
    }
    if (enter >= 0.0) return contact(enter, 1.0);
    // Overlapping: going deeper is in the way, going away is not.
    if (leave > 0.0 && ahead > 0.5 * (front_ + rear_)) return contact(0.0, 1.0);
  }
  Contact result = contact(std::max(0.0, ahead - radius - front_), 1.0);
  if (result.relevance == Relevance::kInTheWay) result.relevance = Relevance::kPotential;
  return result;
}

SweptPath::Contact SweptPath::contact(double distance, double speed) const {
  if (distance > look_ahead_ * speed) return {};
  return {Relevance::kInTheWay, distance, speed};
}

SweptPath::Contact SweptPath::meetTurning(const Vector2d& point, double radius) const {
  const double reach = radius + margin_;
  const double square = (point - centre_).squaredNorm();
  const double outer = farthest_ + reach, inner = std::max(0.0, nearest_ - reach);
  if (square > outer * outer || square < inner * inner) return {};
  const double from_centre = std::sqrt(square);
  if (outOfSector(point - centre_, from_centre, reach)) return {};
  const double speed = std::abs(unit_.w) * from_centre;
  if (from_centre <= farthest_ + radius && from_centre >= nearest_ - radius) {
    const double angle = angleToTouch(point, radius);
    if (angle >= 0.0) return contact(angle * from_centre, speed);
    if (angle == kInside) {
      const Vector2d motion =
          Vector2d(unit_.vx, unit_.vy) + unit_.w * Vector2d(-point.y(), point.x());
      if (motion.dot(point) > 0.0) return contact(0.0, speed);
    }
  }
  const double angle = nearest_ > 0.0 ? angleToLead(point) : angleToTouch(point, reach);
  if (angle == kNever) return {};
  Contact result = contact(std::max(0.0, angle) * from_centre, speed);
  if (result.relevance == Relevance::kInTheWay) result.relevance = Relevance::kPotential;
  return result;
}

double SweptPath::angleToLead(const Vector2d& point) const {
  const Vector2d arm = point - centre_;
  const double sense = unit_.w > 0.0 ? 1.0 : -1.0;
  const double ahead = std::atan2(sense * cross(lead_, arm), lead_.dot(arm));
  if (ahead >= 0.0) return ahead;
  return ahead >= -extent_ ? 0.0 : ahead + kTurn;
}

// The point goes round the centre, seen from the robot, against the robot's turn. It touches where
// its circle enters the half plane of one edge (grown by the inflation) within those of all others.
double SweptPath::angleToTouch(const Vector2d& point, double inflation) const {
  const Vector2d arm = point - centre_;
  const double square = arm.squaredNorm(), from_centre = std::sqrt(square);
  const double sense = unit_.w > 0.0 ? 1.0 : -1.0;
  const std::size_t count = turning_edges_.size();
  // The edges next to the one that is looked at are most likely to be in the way: they come first.
  const auto insideFrom = [&](std::size_t first, std::size_t last, const Vector2d& at) {
    for (std::size_t i = first; i < last; ++i) {
      const TurningEdge& edge = turning_edges_[i < count ? i : i - count];
      if (edge.normal.dot(at) > edge.offset + inflation + kOnEdge) return false;
    }
    return true;
  };
  const double out = reach_ + mitre_ * inflation;
  if (point.squaredNorm() <= out * out && insideFrom(0, count, arm)) return kInside;
  double first = kInfinite;
  for (std::size_t i = 0; i < count; ++i) {
    const TurningEdge& edge = turning_edges_[i];
    const double spread = mitre_ * inflation;
    const double offset = edge.offset + inflation;
    // Where the circle cannot cross the edge itself its line may be crossed elsewhere: no entry.
    const bool may = from_centre <= edge.most + spread && from_centre >= edge.least - spread;
    if (!may && offset > -from_centre) continue;
    const double along = square - offset * offset;
    if (along <= 0.0) {
      if (offset < 0.0) return kNever;  // the whole circle lies outside
      continue;                         // or inside
    }
    const Vector2d entry = offset * edge.normal +
                           sense * std::sqrt(along) * Vector2d(edge.normal.y(), -edge.normal.x());
    if (!insideFrom(i + 1, i + count, entry)) continue;
    const double turn = std::atan2(sense * cross(entry, arm), entry.dot(arm));
    first = std::min(first, turn < 0.0 ? turn + kTurn : turn);
  }
  return first < kInfinite ? first : kNever;
}

Pose2 SweptPath::poseAfter(double way) const {
  return advanced({}, unit_, way);
}

}  // namespace pilothouse
