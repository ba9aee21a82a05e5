#include "core/motion/local_memory.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/motion/may_be_foot.hpp"

namespace pilothouse {
namespace {

using Eigen::Vector2d;

constexpr std::int32_t kAcross = 200;  // cells of the window
constexpr double kCell = 0.05;         // [m]
constexpr double kShrink = 0.03;       // what is so far within the outline cannot be there [m]
constexpr float kArrivedStay = 10.0F;  // [s]
constexpr std::uint8_t kMostLooks = 8;
constexpr unsigned kFreeLooks = 2;  // looks in a row that clear an object

std::int32_t cellOf(double metres) {
  return static_cast<std::int32_t>(std::floor(metres / kCell));
}
double centreOf(std::int32_t cell) {
  return (cell + 0.5) * kCell;
}
std::size_t place(std::int32_t ix, std::int32_t iy) {
  const auto wrapped = [](std::int32_t i) { return ((i % kAcross) + kAcross) % kAcross; };
  return static_cast<std::size_t>(wrapped(iy)) * kAcross + static_cast<std::size_t>(wrapped(ix));
}
unsigned bits(unsigned value) {
  unsigned count = 0;
  for (; value != 0; value &= value - 1) ++count;
  return count;
}

/// An obstacle outweighs a drop-off, that a threshold.
int weight(CellClass kind) {
  if (kind == CellClass::kObstacle) return 3;
  if (kind == CellClass::kDropOff) return 2;
  return kind == CellClass::kThreshold ? 1 : 0;
}

bool isObject(CellClass kind) {
  return weight(kind) > 0;
}

bool standsAlone(const FloorFrame& frame, int ix, int iy) {
  for (int y = iy - 1; y <= iy + 1; ++y) {
    for (int x = ix - 1; x <= ix + 1; ++x) {
      if ((x == ix && y == iy) || !frame.geometry.contains(x, y)) continue;
      const CellClass near = frame.classes[frame.geometry.index(x, y)];
      if (near == CellClass::kObstacle || near == CellClass::kDropOff) return false;
    }
  }
  return true;
}

/// Cells of the endless grid that may hold something of a box round these points.
struct CellBox {
  std::int32_t x0, y0, x1, y1;
  template <class Points>
  CellBox(const Points& points, const Vector2d& middle) {
    Vector2d low = points[0], high = points[0];
    for (const auto& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
    // Never more than the window round the middle: beyond it cells would overwrite each other.
    const Vector2d half = Vector2d::Constant(0.5 * kCell * (kAcross - 2));
    low = low.cwiseMax(middle - half);
    high = high.cwiseMin(middle + half);
    x0 = cellOf(low.x()), y0 = cellOf(low.y()), x1 = cellOf(high.x()), y1 = cellOf(high.y());
  }
};

}  // namespace

LocalMemory::LocalMemory(const AvoidanceParameters& parameters, const Footprint& footprint)
    : parameters_(parameters),
      footprint_(footprint),
      cells_(static_cast<std::size_t>(kAcross) * kAcross) {}

void LocalMemory::clear() {
  std::fill(cells_.begin(), cells_.end(), Cell{});
  frame_ = 0;
  begun_ = false;
}

void LocalMemory::begin(double time) {
  if (!begun_) start_ = time;
  begun_ = true;
}

LocalMemory::Cell& LocalMemory::at(std::int32_t ix, std::int32_t iy) {
  Cell& cell = cells_[place(ix, iy)];
  if (cell.ix != ix || cell.iy != iy) {
    cell = Cell{};
    cell.ix = ix;
    cell.iy = iy;
  }
  return cell;
}

const LocalMemory::Cell* LocalMemory::find(std::int32_t ix, std::int32_t iy) const {
  const Cell& cell = cells_[place(ix, iy)];
  return cell.ix == ix && cell.iy == iy ? &cell : nullptr;
}

void LocalMemory::note(Cell& cell, bool object, float now) const {
  if (cell.frame != frame_) {
    cell.history = static_cast<std::uint8_t>(cell.history << 1U);
    cell.looks = std::min<std::uint8_t>(kMostLooks, static_cast<std::uint8_t>(cell.looks + 1));
    cell.frame = frame_;
  }
  if (object) cell.history |= 1U;
  cell.seen = now;
}

void LocalMemory::add(const FloorFrame& frame, const Pose2& pose) {
  begin(frame.stamp);
  ++frame_;
  mark(frame, pose);
  look(frame, pose);
}

// Forward, cell of the frame by cell: a thin object must not fall between the window's cells.
void LocalMemory::mark(const FloorFrame& frame, const Pose2& pose) {
  const GridGeometry& g = frame.geometry;
  const float now = since(frame.stamp);
  for (int iy = 0; iy < g.size_y; ++iy) {
    for (int ix = 0; ix < g.size_x; ++ix) {
      const std::size_t index = g.index(ix, iy);
      const CellClass kind = frame.classes[index];
      if (!isObject(kind)) continue;
      const Vector2d at_odom =
          pose * Vector2d(static_cast<double>(g.centreX(ix)), static_cast<double>(g.centreY(iy)));
      const std::int32_t cx = cellOf(at_odom.x()), cy = cellOf(at_odom.y());
      if (std::abs(at_odom.x() - pose.x) > 0.5 * kCell * (kAcross - 2) ||
          std::abs(at_odom.y() - pose.y) > 0.5 * kCell * (kAcross - 2)) {
        continue;
      }
      Cell& cell = at(cx, cy);
      const bool again = cell.frame == frame_;
      const bool was_free = cell.looks >= 3 && (cell.history & 7U) == 0;
      note(cell, kind != CellClass::kThreshold, now);
      if (again && weight(cell.kind) >= weight(kind)) continue;
      if (!again && !isObject(cell.kind)) cell.arrived = was_free;
      cell.kind = kind;
      cell.dx = static_cast<float>(at_odom.x() - centreOf(cx));
      cell.dy = static_cast<float>(at_odom.y() - centreOf(cy));
      cell.height = frame.heights[index];
      cell.size = g.cell_size;
      cell.hit = now;
      cell.lone = kind == CellClass::kObstacle && standsAlone(frame, ix, iy);
    }
  }
}

// Backward, cell of the window by cell: each is judged once, and no hole stays between them.
void LocalMemory::look(const FloorFrame& frame, const Pose2& pose) {
  const GridGeometry& g = frame.geometry;
  const double x0 = static_cast<double>(g.x_min), y0 = static_cast<double>(g.y_min);
  const double size = static_cast<double>(g.cell_size);
  const double x1 = x0 + size * g.size_x, y1 = y0 + size * g.size_y;
  const std::array<Vector2d, 4> corners{pose * Vector2d(x0, y0), pose * Vector2d(x1, y0),
                                        pose * Vector2d(x1, y1), pose * Vector2d(x0, y1)};
  const CellBox box(corners, pose.position());
  const float now = since(frame.stamp);
  const double c = std::cos(pose.heading), s = std::sin(pose.heading);
  for (std::int32_t iy = box.y0; iy <= box.y1; ++iy) {
    for (std::int32_t ix = box.x0; ix <= box.x1; ++ix) {
      const double dx = centreOf(ix) - pose.x, dy = centreOf(iy) - pose.y;
      const double fx = (c * dx + s * dy - x0) / size, fy = (c * dy - s * dx - y0) / size;
      if (!(fx >= 0.0 && fy >= 0.0 && fx < g.size_x && fy < g.size_y)) continue;
      const CellClass kind = frame.classes[g.index(static_cast<int>(fx), static_cast<int>(fy))];
      if (kind == CellClass::kUnknown) continue;
      Cell& cell = at(ix, iy);
      if (cell.frame == frame_) continue;  // an object was marked here
      if (!isDrivable(kind)) {             // it was marked in a neighbour
        cell.seen = now;
        continue;
      }
      // Of a thing at the rim of the view the camera may see no more than its foot, which looks
      // like floor: it is gone only where what lies behind it can be seen.
      if (isObject(cell.kind) && mayBeFoot(frame, x0 + size * fx, y0 + size * fy)) {
        cell.seen = now;
        continue;
      }
      note(cell, false, now);
      const bool gone =
          (cell.history & ((1U << kFreeLooks) - 1U)) == 0 || cell.kind == CellClass::kThreshold;
      if (gone && isObject(cell.kind)) cell.kind = CellClass::kUnknown;
    }
  }
}

void LocalMemory::drivenOver(const Pose2& pose, double now) {
  begin(now);
  std::vector<Vector2d>& outline = outline_;
  outline.clear();
  for (const auto& corner : footprint_.corners()) outline.push_back(pose * corner);
  const CellBox box(outline, pose.position());
  for (std::int32_t iy = box.y0; iy <= box.y1; ++iy) {
    for (std::int32_t ix = box.x0; ix <= box.x1; ++ix) {
      const double inside =
          -footprint_.distanceTo(pose.toBase(Vector2d(centreOf(ix), centreOf(iy))));
      if (inside < 0.0) continue;
      Cell& cell = at(ix, iy);
      cell.seen = std::max(0.0F, since(now));
      if (inside > kShrink) cell.kind = CellClass::kUnknown;
    }
  }
}

void LocalMemory::seenFree(const Pose2& sensor, double half_angle, double range,
                           double least_height) {
  const std::array<Vector2d, 2> reach{sensor.position() - Vector2d::Constant(range),
                                      sensor.position() + Vector2d::Constant(range)};
  const CellBox box(reach, sensor.position());
  for (std::int32_t iy = box.y0; iy <= box.y1; ++iy) {
    for (std::int32_t ix = box.x0; ix <= box.x1; ++ix) {
      const Cell* known = find(ix, iy);
      if (known == nullptr || !isObject(known->kind) || !known->arrived || known->frame == frame_ ||
          !(static_cast<double>(known->height) > least_height)) {
        continue;
      }
      const Vector2d p = sensor.toBase({centreOf(ix), centreOf(iy)});
      if (p.norm() > range || std::abs(std::atan2(p.y(), p.x())) > half_angle) continue;
      at(ix, iy).kind = CellClass::kUnknown;
    }
  }
}

bool LocalMemory::confirmed(const Cell& cell) const {
  const unsigned recent = (1U << static_cast<unsigned>(parameters_.confirm_of)) - 1U;
  unsigned seen = bits(cell.history & recent);
  // Its hits may have fallen into neighbours: the robot moves between the looks.
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const Cell* near = dx == 0 && dy == 0 ? nullptr : find(cell.ix + dx, cell.iy + dy);
      if (near != nullptr) seen += bits(near->history & recent);
    }
  }
  return seen >= static_cast<unsigned>(parameters_.confirm_frames);
}

bool LocalMemory::counts(const Cell& cell, const Vector2d& in_base) const {
  return !cell.lone || confirmed(cell) ||
         footprint_.distanceTo(in_base) < parameters_.near_distance;
}

void LocalMemory::collect(const Pose2& pose, double now, std::vector<Obstacle>& objects) const {
  const float time = since(now);
  const double half = 0.5 * kCell * kAcross;
  for (const Cell& cell : cells_) {
    if (!isObject(cell.kind)) continue;
    const bool live = cell.frame == frame_ && (cell.history & 1U) != 0;
    const bool threshold_live = cell.frame == frame_ && cell.kind == CellClass::kThreshold;
    const bool remembered = !live && !threshold_live;
    const Vector2d at_odom(centreOf(cell.ix) + static_cast<double>(cell.dx),
                           centreOf(cell.iy) + static_cast<double>(cell.dy));
    // A cell that the window has left behind may still lie in the ring.
    if (std::abs(at_odom.x() - pose.x) > half || std::abs(at_odom.y() - pose.y) > half) continue;
    const Vector2d p = pose.toBase(at_odom);
    // Who came while the camera watched goes again, mostly: farther off they are seen again anyway
    // before the robot is there.
    const bool gone = remembered && cell.arrived && time - cell.hit > kArrivedStay;
    // However old, what is near is not forgotten: the camera cannot see there, so only driving off
    // or looking again can tell.
    const bool old = remembered && time - cell.hit > static_cast<float>(parameters_.memory);
    if ((old || gone) && footprint_.distanceTo(p) > parameters_.near_distance) continue;
    if (!counts(cell, p)) continue;
    Obstacle object;
    object.position = p.cast<float>();
    object.height = cell.height;
    object.size = cell.size;
    object.kind = cell.kind;
    object.remembered = remembered;
    objects.push_back(object);
  }
}

bool LocalMemory::looked(const Vector2d& place, double now) const {
  const Cell* cell = find(cellOf(place.x()), cellOf(place.y()));
  if (cell == nullptr || cell->seen < 0.0F) return false;
  return static_cast<double>(since(now) - cell->seen) <= std::max(1.0, parameters_.memory);
}

}  // namespace pilothouse
