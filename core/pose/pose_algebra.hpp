#pragma once

#include "core/motion/planar.hpp"

namespace pilothouse {

/// T_a_c of T_a_b and T_b_c.
inline Pose2 composed(const Pose2& T_a_b, const Pose2& T_b_c) {
  const Eigen::Vector2d place = T_a_b * T_b_c.position();
  return {place.x(), place.y(), wrapped(T_a_b.heading + T_b_c.heading)};
}

/// T_a_b of T_w_a and T_w_b: where b is, seen from a.
inline Pose2 relative(const Pose2& T_w_a, const Pose2& T_w_b) {
  const Eigen::Vector2d place = T_w_a.toBase(T_w_b.position());
  return {place.x(), place.y(), wrapped(T_w_b.heading - T_w_a.heading)};
}

inline Pose2 inverse(const Pose2& T_a_b) {
  return relative(T_a_b, Pose2{});
}

/// The pose a share (0..1) of the way from one to the other, straight on.
inline Pose2 between(const Pose2& from, const Pose2& to, double share) {
  return {from.x + share * (to.x - from.x), from.y + share * (to.y - from.y),
          wrapped(from.heading + share * wrapped(to.heading - from.heading))};
}

}  // namespace pilothouse
