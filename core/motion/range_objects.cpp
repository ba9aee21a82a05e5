#include "core/motion/range_objects.hpp"

#include <algorithm>
#include <cmath>

namespace pilothouse {
namespace {

constexpr double kHalfTurn = 3.141592653589793;
constexpr double kMostPieces = 256.0;
/// Neighbouring discs lie closer than their diameter by this factor, so that they overlap.
constexpr double kOverlap = 0.75;

bool sound(const RangeReading& reading, const Eigen::Isometry3d& T_base_ranger, double piece) {
  return !std::isnan(reading.range) && reading.field_of_view > 0.0 &&
         reading.field_of_view <= kHalfTurn && reading.min_range >= 0.0 &&
         reading.max_range > reading.min_range && std::isfinite(reading.max_range) &&
         std::isfinite(piece) && piece > 0.0 && T_base_ranger.matrix().allFinite();
}

}  // namespace

bool objectsOf(const RangeReading& reading, const Eigen::Isometry3d& T_base_ranger, double piece,
               std::vector<Obstacle>& objects) {
  objects.clear();
  if (!sound(reading, T_base_ranger, piece)) return false;
  if (reading.range >= reading.max_range) return true;
  const double range = std::max(reading.range, reading.min_range);
  const double arc = range * reading.field_of_view;
  const double pieces = std::min(kMostPieces, std::ceil(arc / (kOverlap * piece)) + 1.0);
  const double spacing = reading.field_of_view / pieces;
  // Where so many discs of that size do not reach round the arc, larger ones do.
  const double size = std::max(piece, range * spacing / kOverlap);
  objects.resize(static_cast<std::size_t>(pieces));
  double angle = -0.5 * reading.field_of_view + 0.5 * spacing;
  for (auto& object : objects) {
    const Eigen::Vector3d place =
        T_base_ranger * Eigen::Vector3d(range * std::cos(angle), range * std::sin(angle), 0.0);
    object = Obstacle{};
    object.position = place.head<2>().cast<float>();
    object.size = static_cast<float>(size);
    angle += spacing;
  }
  return true;
}

}  // namespace pilothouse
