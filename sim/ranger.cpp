#include "sim/ranger.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pilothouse::sim {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kPi = 3.14159265358979323846;
constexpr int kRings = 5;  ///< of rays round the middle one; ring i has 6 i rays: 91 in all

}  // namespace

Ranger::Ranger(const SimRanger& ranger, const RangerNoise& noise, std::uint64_t seed)
    : ranger_(ranger), noise_(noise), random_(seed) {
  rays_.push_back(Eigen::Vector3d::UnitX());
  for (int ring = 1; ring <= kRings; ++ring) {
    const double off = 0.5 * ranger.field_of_view * ring / kRings;
    for (int i = 0; i < 6 * ring; ++i) {
      const double round = 2.0 * kPi * i / (6 * ring);
      rays_.emplace_back(std::cos(off), std::sin(off) * std::cos(round),
                         std::sin(off) * std::sin(round));
    }
  }
}

double Ranger::measure(const WorldScene& scene, const Eigen::Isometry3d& T_world_base) {
  const double shift = noise_.spread * random_.normal();
  const bool lost = random_.chance(noise_.drop_out);
  const double echo = nearestEcho(scene, T_world_base * ranger_.T_base_ranger);
  if (lost || echo == kInfinity) return kInfinity;
  const double distance = echo + shift;
  if (distance > ranger_.max_range) return kInfinity;
  return distance < ranger_.min_range ? -kInfinity : distance;
}

double Ranger::nearestEcho(const WorldScene& scene, const Eigen::Isometry3d& T_world_ranger) const {
  const double steepest = std::sin(noise_.grazing_deg * kPi / 180.0);
  const Eigen::Vector3d origin = T_world_ranger.translation();
  double nearest = kInfinity;
  for (const auto& ray : rays_) {
    const Eigen::Vector3d direction = T_world_ranger.linear() * ray;
    const auto hit =
        scene.cast(origin, direction, std::min(nearest, ranger_.max_range), kRangerRay);
    if (!hit) continue;
    const double facing = std::abs(hit->normal.cast<double>().dot(direction));
    if (facing >= steepest) nearest = static_cast<double>(hit->distance);
  }
  return nearest;
}

}  // namespace pilothouse::sim
