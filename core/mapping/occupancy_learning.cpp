// How an occupancy map learns from a frame.

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/mapping/occupancy_map.hpp"
#include "core/mapping/ray_walk.hpp"
#include "core/motion/may_be_foot.hpp"

namespace pilothouse {
namespace {

using Eigen::Vector2d;

constexpr int kBlock = OccupancyMap::kBlock;

CellEvidence evidenceOf(CellClass kind) {
  switch (kind) {
    case CellClass::kFloor:
      return CellEvidence::kFree;
    case CellClass::kThreshold:
      return CellEvidence::kThreshold;
    case CellClass::kObstacle:
      return CellEvidence::kPassing;
    case CellClass::kDropOff:
      return CellEvidence::kDropOff;
    case CellClass::kUnknown:
      break;
  }
  return CellEvidence::kNone;
}

bool anySaid(const std::uint8_t* evidence, int side) {
  for (int y = 0; y < kBlock; ++y, evidence += side) {
    std::uint64_t words[2];
    std::memcpy(words, evidence, sizeof words);
    if ((words[0] | words[1]) != 0) return true;
  }
  return false;
}
static_assert(kBlock == 16, "a row of evidence is two words");

}  // namespace

const char* OccupancyMap::begin(const Pose2& pose) {
  if (!pose.finite()) return "the pose is not finite";
  const double half = 0.5 * parameters_.max_side;
  if (!(std::abs(pose.x) <= half && std::abs(pose.y) <= half)) {
    return "the robot is outside of the map's square";
  }
  const CellPlace robot = cellOf(pose.x, pose.y);
  const int half_side = side_ / kBlock / 2;
  window_x_ = (blockOf(robot.ix) - half_side) * kBlock;
  window_y_ = (blockOf(robot.iy) - half_side) * kBlock;
  low_x_ = low_y_ = side_ / kBlock;
  high_x_ = high_y_ = -1;
  return nullptr;
}

inline void OccupancyMap::note(std::int32_t ix, std::int32_t iy, CellEvidence evidence) {
  const std::int32_t x = ix - window_x_, y = iy - window_y_;
  if (x < 0 || y < 0 || x >= side_ || y >= side_) return;
  std::uint8_t& cell = evidence_[static_cast<std::size_t>(y) * static_cast<std::size_t>(side_) +
                                 static_cast<std::size_t>(x)];
  cell = std::max(cell, static_cast<std::uint8_t>(evidence));
  low_x_ = std::min(low_x_, x / kBlock), high_x_ = std::max(high_x_, x / kBlock);
  low_y_ = std::min(low_y_, y / kBlock), high_y_ = std::max(high_y_, y / kBlock);
}

template <class Keeps>
void OccupancyMap::learn(Keeps keeps) {
  for (int row = low_y_; row <= high_y_; ++row) {
    for (int column = low_x_; column <= high_x_; ++column) {
      std::uint8_t* evidence =
          &evidence_[static_cast<std::size_t>(row * kBlock) * static_cast<std::size_t>(side_) +
                     static_cast<std::size_t>(column * kBlock)];
      if (!anySaid(evidence, side_)) continue;
      learnBlock(blockOf(window_x_) + column, blockOf(window_y_) + row, evidence, keeps);
    }
  }
}

template <class Keeps>
void OccupancyMap::learnBlock(int column, int row, std::uint8_t* evidence, Keeps keeps) {
  Block* block = ensureBlock(column, row);
  std::uint32_t changes = 0;
  for (int y = 0; y < kBlock; ++y, evidence += side_) {
    for (int x = 0; x < kBlock; ++x) {
      const auto said = static_cast<CellEvidence>(evidence[x]);
      if (said == CellEvidence::kNone) continue;
      evidence[x] = 0;
      if (block == nullptr) {
        ++refused_cells_;
        continue;
      }
      MapCellState& cell = (*block)[static_cast<std::size_t>(y * kBlock + x)];
      const bool cleared = said == CellEvidence::kFree || said == CellEvidence::kThreshold;
      if (cleared && cell.odds >= rule_.occupied &&
          keeps(CellPlace{column * kBlock + x, row * kBlock + y})) {
        continue;
      }
      const MapCell before = rule_.judge(cell);
      rule_.learn(cell, said);
      changes += before != rule_.judge(cell) ? 1U : 0U;
    }
  }
  if (changes > 0) ++version_;
}

// Forward, cell of the frame by cell: a thin object must not fall between the map's cells.
void OccupancyMap::markFloor(const FloorFrame& frame, const Pose2& pose) {
  const GridGeometry& g = frame.geometry;
  const double reach = parameters_.reach;
  for (int iy = 0; iy < g.size_y; ++iy) {
    const CellClass* row = frame.classes + g.index(0, iy);
    for (int ix = 0; ix < g.size_x; ++ix) {
      if (row[ix] == CellClass::kUnknown || row[ix] == CellClass::kFloor) continue;
      const Vector2d p(static_cast<double>(g.centreX(ix)), static_cast<double>(g.centreY(iy)));
      if (p.squaredNorm() > reach * reach) continue;
      const Vector2d at = pose * p;
      const CellPlace place = cellOf(at.x(), at.y());
      note(place.ix, place.iy, evidenceOf(row[ix]));
    }
  }
}

// Backward, cell of the map by cell: no hole stays between the frame's cells.
void OccupancyMap::lookAtFloor(const FloorFrame& frame, const Pose2& pose) {
  const GridGeometry& g = frame.geometry;
  const double x0 = static_cast<double>(g.x_min), y0 = static_cast<double>(g.y_min);
  const double size = static_cast<double>(g.cell_size);
  const double reach = parameters_.reach;
  Vector2d low = pose.position(), high = low;
  bool first = true;
  for (const double x : {x0, x0 + size * g.size_x}) {
    for (const double y : {y0, y0 + size * g.size_y}) {
      const Vector2d corner = pose * Vector2d(x, y);
      low = first ? corner : low.cwiseMin(corner).eval();
      high = first ? corner : high.cwiseMax(corner).eval();
      first = false;
    }
  }
  low = low.cwiseMax((pose.position().array() - reach).matrix());
  high = high.cwiseMin((pose.position().array() + reach).matrix());
  if (!(low.x() <= high.x() && low.y() <= high.y())) return;
  const CellPlace begin = cellOf(low.x(), low.y()), end = cellOf(high.x(), high.y());
  const double c = std::cos(pose.heading), s = std::sin(pose.heading);
  for (std::int32_t iy = begin.iy; iy <= end.iy; ++iy) {
    for (std::int32_t ix = begin.ix; ix <= end.ix; ++ix) {
      const Vector2d d = centreOf({ix, iy}) - pose.position();
      const double fx = (c * d.x() + s * d.y() - x0) / size;
      const double fy = (c * d.y() - s * d.x() - y0) / size;
      if (!(fx >= 0.0 && fy >= 0.0 && fx < g.size_x && fy < g.size_y)) continue;
      const CellClass kind = frame.classes[g.index(static_cast<int>(fx), static_cast<int>(fy))];
      if (!isDrivable(kind) || d.squaredNorm() > reach * reach) continue;
      note(ix, iy, evidenceOf(kind));
    }
  }
}

const char* OccupancyMap::addFloor(const FloorFrame& frame, const Pose2& pose) {
  if (const char* fault = begin(pose)) return fault;
  lookAtFloor(frame, pose);
  markFloor(frame, pose);
  learn([&](CellPlace place) {
    const Vector2d p = pose.toBase(centreOf(place));
    return mayBeFoot(frame, p.x(), p.y());
  });
  reachRound(pose);
  return nullptr;
}

void OccupancyMap::reachRound(const Pose2& pose) {
  if (block_count_ == 0) return;
  constexpr double kRound = 0.5;  // [m]
  const std::size_t before = block_count_;
  const CellPlace low = cellOf(pose.x - kRound, pose.y - kRound);
  const CellPlace high = cellOf(pose.x + kRound, pose.y + kRound);
  for (int row = blockOf(low.iy); row <= blockOf(high.iy); ++row) {
    for (int column = blockOf(low.ix); column <= blockOf(high.ix); ++column) {
      ensureBlock(column, row);
    }
  }
  if (block_count_ != before) ++version_;
}

const char* OccupancyMap::addScan(const PlanarScan& scan, const Pose2& pose) {
  if (!scan.T_base_scan.finite() || !std::isfinite(scan.angle_min) ||
      !std::isfinite(scan.increment)) {
    return "the scan's pose or angles are not finite";
  }
  if (const char* fault = begin(pose)) return fault;
  const Vector2d sensor = pose * scan.T_base_scan.position();
  const double heading = pose.heading + scan.T_base_scan.heading + scan.angle_min;
  const double size = parameters_.cell_size;
  const Vector2d start = (sensor - anchor_) / size;
  for (std::size_t i = 0; i < scan.count; ++i) {
    const BeamMeaning beam = meaningOf(scan, static_cast<double>(scan.ranges[i]),
                                       parameters_.clear_range, parameters_.reach);
    if (!(beam.free_until > 0.0)) continue;
    const double angle = heading + static_cast<double>(i) * scan.increment;
    const Vector2d end =
        start + beam.free_until / size * Vector2d(std::cos(angle), std::sin(angle));
    walkRay(start.x(), start.y(), end.x(), end.y(),
            [this](std::int32_t ix, std::int32_t iy) { note(ix, iy, CellEvidence::kFree); });
    if (beam.hit) {
      note(static_cast<std::int32_t>(std::floor(end.x())),
           static_cast<std::int32_t>(std::floor(end.y())), CellEvidence::kObstacle);
    }
  }
  learn([](CellPlace) { return false; });
  return nullptr;
}

void OccupancyMap::markDisc(const Obstacle& object, const Vector2d& centre) {
  const CellEvidence evidence =
      object.kind == CellClass::kObstacle ? CellEvidence::kObstacle : evidenceOf(object.kind);
  const double radius = 0.5 * static_cast<double>(object.size);
  const CellPlace low = cellOf(centre.x() - radius, centre.y() - radius);
  const CellPlace high = cellOf(centre.x() + radius, centre.y() + radius);
  for (std::int32_t iy = low.iy; iy <= high.iy; ++iy) {
    for (std::int32_t ix = low.ix; ix <= high.ix; ++ix) {
      if ((centreOf({ix, iy}) - centre).squaredNorm() <= radius * radius) note(ix, iy, evidence);
    }
  }
  const CellPlace own = cellOf(centre.x(), centre.y());
  note(own.ix, own.iy, evidence);
}

const char* OccupancyMap::addObjects(const std::vector<Obstacle>& objects, const Pose2& pose) {
  constexpr float kLargest = 2.0F;  // [m]
  if (const char* fault = begin(pose)) return fault;
  for (const auto& object : objects) {
    if (!object.position.allFinite() || !(object.size >= 0.0F && object.size <= kLargest)) continue;
    if (static_cast<double>(object.position.norm()) > parameters_.reach) continue;
    markDisc(object, pose * object.position.cast<double>());
  }
  learn([](CellPlace) { return false; });
  return nullptr;
}

}  // namespace pilothouse
