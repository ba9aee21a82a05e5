#include "core/mapping/occupancy_reference.hpp"

#include <cmath>

#include "core/mapping/ray_walk.hpp"
#include "core/motion/may_be_foot.hpp"

namespace pilothouse {
namespace {

using Eigen::Vector2d;

CellEvidence evidenceOf(CellClass kind) {
  if (kind == CellClass::kFloor) return CellEvidence::kFree;
  if (kind == CellClass::kThreshold) return CellEvidence::kThreshold;
  if (kind == CellClass::kDropOff) return CellEvidence::kDropOff;
  return kind == CellClass::kObstacle ? CellEvidence::kPassing : CellEvidence::kNone;
}

}  // namespace

bool OccupancyReference::isInside(std::int32_t ix, std::int32_t iy) const {
  const double side = 16.0 * parameters_.cell_size;
  const double half = std::ceil(0.5 * parameters_.max_side / side - 1e-9) * 16.0;
  return ix >= -half && ix < half && iy >= -half && iy < half;
}

void OccupancyReference::learn(const Evidence& evidence, const FloorFrame* frame,
                               const Pose2& pose) {
  const double size = parameters_.cell_size;
  for (const auto& said : evidence) {
    const auto [ix, iy] = said.first;
    if (!isInside(ix, iy) || said.second == CellEvidence::kNone) continue;
    MapCellState& cell = cells_[said.first];
    const bool cleared =
        said.second == CellEvidence::kFree || said.second == CellEvidence::kThreshold;
    if (frame != nullptr && cleared && cell.odds >= rule_.occupied) {
      const Vector2d p = pose.toBase({(ix + 0.5) * size, (iy + 0.5) * size});
      if (mayBeFoot(*frame, p.x(), p.y())) continue;
    }
    rule_.learn(cell, said.second);
  }
}

void OccupancyReference::addFloor(const FloorFrame& frame, const Pose2& pose) {
  const GridGeometry& g = frame.geometry;
  const double size = parameters_.cell_size, reach = parameters_.reach;
  Evidence evidence;
  const auto note = [&](std::int32_t ix, std::int32_t iy, CellClass kind) {
    CellEvidence& cell = evidence[{ix, iy}];
    cell = std::max(cell, evidenceOf(kind));
  };
  for (int iy = 0; iy < g.size_y; ++iy) {
    for (int ix = 0; ix < g.size_x; ++ix) {
      const CellClass kind = frame.classes[g.index(ix, iy)];
      if (kind == CellClass::kUnknown || kind == CellClass::kFloor) continue;
      const Vector2d p(static_cast<double>(g.centreX(ix)), static_cast<double>(g.centreY(iy)));
      if (p.squaredNorm() > reach * reach) continue;
      const Vector2d at = pose * p;
      note(static_cast<std::int32_t>(std::floor(at.x() / size)),
           static_cast<std::int32_t>(std::floor(at.y() / size)), kind);
    }
  }
  const auto span = static_cast<std::int32_t>(std::ceil(reach / size)) + 1;
  const auto robot_x = static_cast<std::int32_t>(std::floor(pose.x / size));
  const auto robot_y = static_cast<std::int32_t>(std::floor(pose.y / size));
  for (std::int32_t iy = robot_y - span; iy <= robot_y + span; ++iy) {
    for (std::int32_t ix = robot_x - span; ix <= robot_x + span; ++ix) {
      const Vector2d p = pose.toBase({(ix + 0.5) * size, (iy + 0.5) * size});
      const double gsize = static_cast<double>(g.cell_size);
      const double fx = (p.x() - static_cast<double>(g.x_min)) / gsize;
      const double fy = (p.y() - static_cast<double>(g.y_min)) / gsize;
      if (!(fx >= 0.0 && fy >= 0.0 && fx < g.size_x && fy < g.size_y)) continue;
      const CellClass kind = frame.classes[g.index(static_cast<int>(fx), static_cast<int>(fy))];
      if (isDrivable(kind) && p.squaredNorm() <= reach * reach) note(ix, iy, kind);
    }
  }
  learn(evidence, &frame, pose);
}

void OccupancyReference::addScan(const PlanarScan& scan, const Pose2& pose) {
  const double size = parameters_.cell_size;
  const Vector2d sensor = pose * scan.T_base_scan.position();
  Evidence evidence;
  for (std::size_t i = 0; i < scan.count; ++i) {
    const BeamMeaning beam = meaningOf(scan, static_cast<double>(scan.ranges[i]),
                                       parameters_.clear_range, parameters_.reach);
    if (!(beam.free_until > 0.0)) continue;
    const double angle = pose.heading + scan.T_base_scan.heading + scan.angle_min +
                         static_cast<double>(i) * scan.increment;
    const Vector2d start = sensor / size;
    const Vector2d end =
        start + beam.free_until / size * Vector2d(std::cos(angle), std::sin(angle));
    walkRay(start.x(), start.y(), end.x(), end.y(), [&](std::int32_t ix, std::int32_t iy) {
      CellEvidence& cell = evidence[{ix, iy}];
      cell = std::max(cell, CellEvidence::kFree);
    });
    if (!beam.hit) continue;
    evidence[{static_cast<std::int32_t>(std::floor(end.x())),
              static_cast<std::int32_t>(std::floor(end.y()))}] = CellEvidence::kObstacle;
  }
  learn(evidence, nullptr, pose);
}

void OccupancyReference::addObjects(const std::vector<Obstacle>& objects, const Pose2& pose) {
  const double size = parameters_.cell_size;
  Evidence evidence;
  for (const auto& object : objects) {
    if (!object.position.allFinite() ||
        static_cast<double>(object.position.norm()) > parameters_.reach) {
      continue;
    }
    const Vector2d centre = pose * object.position.cast<double>();
    const double radius = 0.5 * static_cast<double>(object.size);
    const auto kind =
        object.kind == CellClass::kObstacle ? CellEvidence::kObstacle : evidenceOf(object.kind);
    const auto own_x = static_cast<std::int32_t>(std::floor(centre.x() / size));
    const auto own_y = static_cast<std::int32_t>(std::floor(centre.y() / size));
    const auto span = static_cast<std::int32_t>(radius / size) + 1;
    for (std::int32_t iy = own_y - span; iy <= own_y + span; ++iy) {
      for (std::int32_t ix = own_x - span; ix <= own_x + span; ++ix) {
        const Vector2d at((ix + 0.5) * size, (iy + 0.5) * size);
        const bool own = ix == own_x && iy == own_y;
        if (!own && (at - centre).squaredNorm() > radius * radius) continue;
        CellEvidence& cell = evidence[{ix, iy}];
        cell = std::max(cell, kind);
      }
    }
  }
  learn(evidence, nullptr, pose);
}

}  // namespace pilothouse
