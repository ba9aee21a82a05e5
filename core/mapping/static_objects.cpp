#include "core/mapping/static_objects.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "core/motion/may_be_foot.hpp"

namespace pilothouse {
namespace {

using Eigen::Vector2d;

constexpr std::int32_t kAcross = 256;  // cells of the window
constexpr double kLongestGap = 0.3;    // between looks that count as one [s]
constexpr double kLongestEmpty = 0.6;  // before a place, of which nothing comes back either [m]
constexpr int kFloorBefore = 3;        // cells of floor before that, of ...
constexpr int kCellsBefore = 5;        // ... so many
constexpr float kUsualHeight = 0.3F;   // of what came with the map, unseen yet [m]

std::size_t slotOf(CellPlace place) {
  constexpr std::int32_t kMask = kAcross - 1;
  return static_cast<std::size_t>(place.iy & kMask) * kAcross +
         static_cast<std::size_t>(place.ix & kMask);
}
static_assert((kAcross & (kAcross - 1)) == 0, "a power of two wraps by its mask");

bool isNear(const Vector2d& place, const Pose2& pose, double cell_size) {
  const double half = 0.5 * (kAcross - 2) * cell_size;
  return std::abs(place.x() - pose.x) < half && std::abs(place.y() - pose.y) < half;
}

struct GridPlace {
  int ix, iy;
};
GridPlace placeIn(const GridGeometry& g, const Vector2d& p) {
  const double size = static_cast<double>(g.cell_size);
  return {static_cast<int>(std::floor((p.x() - static_cast<double>(g.x_min)) / size)),
          static_cast<int>(std::floor((p.y() - static_cast<double>(g.y_min)) / size))};
}

bool standsSomething(const FloorFrame& frame, GridPlace place) {
  for (int y = place.iy - 1; y <= place.iy + 1; ++y) {
    for (int x = place.ix - 1; x <= place.ix + 1; ++x) {
      const GridGeometry& g = frame.geometry;
      if (g.contains(x, y) && frame.classes[g.index(x, y)] == CellClass::kObstacle) return true;
    }
  }
  return false;
}

}  // namespace

std::vector<std::string> validate(const StaticParameters& p) {
  std::vector<std::string> faults;
  forEachStaticParameter(p, [&faults](const char* key, auto value, auto low, auto high) {
    if (value >= low && value <= high) return;
    std::ostringstream line;
    line << key << " is " << value << ", expected " << low << " to " << high;
    faults.push_back(line.str());
  });
  return faults;
}

StaticObjects::StaticObjects(const StaticParameters& parameters)
    : parameters_(parameters), tracks_(static_cast<std::size_t>(kAcross) * kAcross) {
  std::string all;
  for (const auto& fault : validate(parameters)) all += (all.empty() ? "" : "; ") + fault;
  if (!all.empty()) throw std::invalid_argument(all);
}

void StaticObjects::clear() {
  std::fill(tracks_.begin(), tracks_.end(), Track{});
}

StaticObjects::Track& StaticObjects::at(CellPlace place) {
  Track& track = tracks_[slotOf(place)];
  if (track.ix != place.ix || track.iy != place.iy) {
    track = Track{};
    track.ix = place.ix;
    track.iy = place.iy;
  }
  return track;
}

const StaticObjects::Track* StaticObjects::find(CellPlace place) const {
  const Track& track = tracks_[slotOf(place)];
  return track.ix == place.ix && track.iy == place.iy ? &track : nullptr;
}

void StaticObjects::see(const std::vector<Obstacle>& objects, const Pose2& pose, double stamp,
                        OccupancyMap& map) {
  if (!pose.finite() || !std::isfinite(stamp)) return;
  entering_.clear();
  for (const auto& object : objects) {
    if (object.kind != CellClass::kObstacle || object.remembered) continue;
    if (object.source != 0 && !parameters_.echoes) continue;
    if (!object.position.allFinite() || object.position.norm() > 1e3F) continue;
    const Vector2d place_in_map = pose * object.position.cast<double>();
    if (!isNear(place_in_map, pose, map.parameters().cell_size)) continue;
    const CellPlace place = map.cellOf(place_in_map.x(), place_in_map.y());
    Track& track = at(place);
    const bool before = track.last >= 0.0 && track.last <= stamp;
    if (before) {
      track.seen += static_cast<float>(std::min(stamp - track.last, kLongestGap));
    }
    track.last = stamp;
    track.gone = 0;
    track.height = std::isfinite(object.height) ? object.height : kUsualHeight;
    if (static_cast<double>(track.seen) < parameters_.enter_time) continue;
    if (map.at(place) != MapCell::kOccupied) entering_.push_back(place);
  }
  map.set(entering_, MapCell::kOccupied);
  entered_ += entering_.size();
}

bool StaticObjects::couldSee(const Vector2d& p, float height) const {
  return sight_ && sight_->sees({p.x(), p.y(), 0.0}) &&
         sight_->sees({p.x(), p.y(), static_cast<double>(height)});
}

/// Whether nothing on the way from the camera hides the place, and its nearer part shows floor:
/// there the camera does see. Before the place there may be nothing for as long as a thing is deep.
bool StaticObjects::openBefore(const FloorFrame& frame, const Vector2d& p) const {
  const GridGeometry& g = frame.geometry;
  const double size = static_cast<double>(g.cell_size);
  const Vector2d camera = sight_->T_base_optical.translation().head<2>();
  const double distance = (p - camera).norm();
  if (distance < size) return false;
  const Vector2d step = (p - camera) / distance;
  int before = 0, floor = 0;
  for (double way = distance - size; way > 0.0; way -= size) {
    const GridPlace place = placeIn(g, camera + way * step);
    if (!g.contains(place.ix, place.iy)) break;
    const CellClass kind = frame.classes[g.index(place.ix, place.iy)];
    if (kind == CellClass::kObstacle || kind == CellClass::kDropOff) return false;
    const bool empty = before == 0 && kind == CellClass::kUnknown;
    if (empty && distance - way > kLongestEmpty) return false;
    if (empty || before >= kCellsBefore) continue;
    ++before;
    if (isDrivable(kind)) ++floor;
  }
  return floor >= kFloorBefore;
}

StaticObjects::Verdict StaticObjects::judge(const FloorFrame& frame, const Vector2d& p,
                                            float height) const {
  const GridPlace place = placeIn(frame.geometry, p);
  if (!frame.geometry.contains(place.ix, place.iy)) return Verdict::kNothing;
  if (standsSomething(frame, place)) return Verdict::kThere;
  const CellClass kind = frame.classes[frame.geometry.index(place.ix, place.iy)];
  if (isDrivable(kind)) {
    const bool whole = couldSee(p, height) || !mayBeFoot(frame, p.x(), p.y());
    return whole ? Verdict::kFloor : Verdict::kNothing;
  }
  const bool empty = kind == CellClass::kUnknown && couldSee(p, height) && openBefore(frame, p);
  return empty ? Verdict::kEmpty : Verdict::kNothing;
}

void StaticObjects::look(const FloorFrame& frame, const Pose2& pose, OccupancyMap& map) {
  const GridGeometry& g = frame.geometry;
  if (!pose.finite() || std::abs(pose.x) > 1e5 || std::abs(pose.y) > 1e5) return;
  const double x0 = static_cast<double>(g.x_min), y0 = static_cast<double>(g.y_min);
  const double size = static_cast<double>(g.cell_size);
  const std::array<Vector2d, 4> corners{
      pose * Vector2d(x0, y0), pose * Vector2d(x0 + size * g.size_x, y0),
      pose * Vector2d(x0, y0 + size * g.size_y),
      pose * Vector2d(x0 + size * g.size_x, y0 + size * g.size_y)};
  Vector2d low = corners[0], high = low;
  for (const auto& corner : corners) {
    low = low.cwiseMin(corner).eval();
    high = high.cwiseMax(corner).eval();
  }
  const double half = 0.5 * (kAcross - 2) * map.parameters().cell_size;
  low = low.cwiseMax((pose.position().array() - half).matrix()).eval();
  high = high.cwiseMin((pose.position().array() + half).matrix()).eval();
  const CellPlace begin = map.cellOf(low.x(), low.y()), end = map.cellOf(high.x(), high.y());
  floor_.clear();
  empty_.clear();
  for (std::int32_t iy = begin.iy; iy <= end.iy; ++iy) {
    for (std::int32_t ix = begin.ix; ix <= end.ix; ++ix) {
      const CellPlace place{ix, iy};
      const Track* known = find(place);
      const bool followed = known != nullptr && known->last >= 0.0;
      const bool stands = map.at(place) == MapCell::kOccupied;
      if (!followed && !stands) continue;
      const Vector2d p = pose.toBase(map.centreOf(place));
      const Verdict verdict = judge(frame, p, followed ? known->height : kUsualHeight);
      if (verdict == Verdict::kNothing) continue;
      Track& track = at(place);
      track.gone = verdict == Verdict::kThere ? 0 : track.gone + 1;
      if (track.gone < parameters_.gone_frames) continue;
      track.gone = 0;
      track.last = -1.0;
      track.seen = 0.0F;
      if (stands) (verdict == Verdict::kFloor ? floor_ : empty_).push_back(place);
    }
  }
  map.set(floor_, MapCell::kFree);
  map.set(empty_, MapCell::kUnknown);
  cleared_ += floor_.size() + empty_.size();
}

void StaticObjects::collect(const Pose2& pose, const OccupancyMap& map,
                            std::vector<Obstacle>& out) const {
  const double half = 0.5 * (kAcross - 2) * map.parameters().cell_size;
  const CellPlace begin = map.cellOf(pose.x - half, pose.y - half);
  const CellPlace end = map.cellOf(pose.x + half, pose.y + half);
  for (std::int32_t iy = begin.iy; iy <= end.iy; ++iy) {
    for (std::int32_t ix = begin.ix; ix <= end.ix; ++ix) {
      const CellPlace place{ix, iy};
      if (map.at(place) != MapCell::kOccupied) continue;
      Obstacle object;
      object.position = map.centreOf(place).cast<float>();
      object.size = static_cast<float>(map.parameters().cell_size);
      const Track* track = find(place);
      if (track != nullptr && track->last >= 0.0) object.height = track->height;
      out.push_back(object);
    }
  }
}

}  // namespace pilothouse
