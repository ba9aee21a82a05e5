#include "volume/volume_window.hpp"

#include <algorithm>
#include <cmath>

namespace pilothouse {
namespace {

constexpr double kStep = 0.05;         // log-odds of a unit
constexpr std::uint8_t kSeenFree = 1;  // marks of a frame
constexpr std::uint8_t kSeenHit = 2;
constexpr std::uint8_t kAimedAt = 4;
constexpr std::uint8_t kFrame = kSeenFree | kSeenHit | kAimedAt;
constexpr int kJudgedShift = 4;
constexpr std::uint64_t kNobody = ~std::uint64_t{0};

int units(double odds) {
  return static_cast<int>(std::lround(odds / kStep));
}
std::int32_t powerOfTwo(double least) {
  std::int32_t power = 1;
  while (power < least) power *= 2;
  return power;
}
std::int32_t voxelOf(float coordinate) {
  return static_cast<std::int32_t>(std::floor(coordinate));
}
std::uint64_t ownerOf(std::int32_t column, std::int32_t row) {
  return std::uint64_t{static_cast<std::uint32_t>(row)} << 32U | static_cast<std::uint32_t>(column);
}

}  // namespace

VolumeWindow::VolumeWindow(const VolumeParameters& p)
    : parameters_(p),
      hit_(units(p.hit)),
      miss_(units(p.miss)),
      most_(units(p.most)),
      occupied_(units(p.occupied)),
      free_(units(p.free)),
      side_(powerOfTwo(2.0 * p.reach / p.voxel + 2.0 * kBlock)),
      bottom_(static_cast<std::int32_t>(std::floor(-p.below / p.voxel))),
      top_(static_cast<std::int32_t>(std::ceil(p.above / p.voxel))) {
  height_ = powerOfTwo(top_ - bottom_);
  const auto columns = static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_);
  odds_.assign(columns * static_cast<std::size_t>(height_), 0);
  marks_.assign(odds_.size(), 0);
  owners_.assign(columns / (kBlock * kBlock), kNobody);
}

void VolumeWindow::clear() {
  std::fill(odds_.begin(), odds_.end(), std::int8_t{0});
  std::fill(marks_.begin(), marks_.end(), std::uint8_t{0});
  std::fill(owners_.begin(), owners_.end(), kNobody);
}

bool VolumeWindow::contains(VoxelPlace place) const {
  const std::int32_t half = side_ / 2 - kBlock;
  return place.z >= bottom_ && place.z < top_ && std::abs(place.x - centre_.x) < half &&
         std::abs(place.y - centre_.y) < half;
}

const std::vector<VoxelPlace>& VolumeWindow::moveTo(const Eigen::Vector3d& camera) {
  const Eigen::Vector3f at = (camera / parameters_.voxel).cast<float>();
  centre_ = {voxelOf(at.x()), voxelOf(at.y()), voxelOf(at.z())};
  entered_.clear();
  const auto reach =
      static_cast<std::int32_t>(std::ceil(parameters_.reach / parameters_.voxel)) + 1;
  const std::int32_t blocks = side_ / kBlock;
  const auto blockOf = [](std::int32_t voxel) { return voxel >> 3; };
  static_assert(kBlock == 8, "a block is three bits");
  for (std::int32_t row = blockOf(centre_.y - reach); row <= blockOf(centre_.y + reach); ++row) {
    for (std::int32_t column = blockOf(centre_.x - reach); column <= blockOf(centre_.x + reach);
         ++column) {
      std::uint64_t& owner = owners_[static_cast<std::size_t>((row & (blocks - 1)) * blocks +
                                                              (column & (blocks - 1)))];
      if (owner == ownerOf(column, row)) continue;
      owner = ownerOf(column, row);
      entered_.push_back({column * kBlock, row * kBlock, bottom_});
      for (std::int32_t y = 0; y < kBlock; ++y) {
        const std::size_t first = slot(column * kBlock, row * kBlock + y, bottom_);
        const auto count = static_cast<std::ptrdiff_t>(kBlock * height_);
        std::fill_n(odds_.begin() + static_cast<std::ptrdiff_t>(first), count, std::int8_t{0});
        std::fill_n(marks_.begin() + static_cast<std::ptrdiff_t>(first), count, std::uint8_t{0});
      }
    }
  }
  return entered_;
}

void VolumeWindow::forget(VoxelPlace low, std::int32_t edge) {
  for (std::uint64_t& owner : owners_) {
    if (owner == kNobody) continue;
    const auto x = static_cast<std::int32_t>(static_cast<std::uint32_t>(owner)) * kBlock;
    const auto y = static_cast<std::int32_t>(static_cast<std::uint32_t>(owner >> 32U)) * kBlock;
    if (x >= low.x && x < low.x + edge && y >= low.y && y < low.y + edge) owner = kNobody;
  }
}

void VolumeWindow::put(VoxelPlace place, Voxel judged) {
  if (place.z < bottom_ || place.z >= top_) return;
  const std::size_t at = slot(place.x, place.y, place.z);
  const int odds = judged == Voxel::kOccupied ? most_ : judged == Voxel::kFree ? -most_ : 0;
  odds_[at] = static_cast<std::int8_t>(odds);
  marks_[at] = static_cast<std::uint8_t>(static_cast<unsigned>(judged) << kJudgedShift);
}

/// Cuts the way to where the map ends, and takes it where no other ends in the same voxel.
inline void VolumeWindow::aim(const Eigen::Vector3f& from, Eigen::Vector3f end, bool hit) {
  const auto low = static_cast<float>(bottom_) + 0.01F, high = static_cast<float>(top_) - 0.01F;
  if (end.z() < low || end.z() > high) {
    const float border = end.z() < low ? low : high;
    end = from + (border - from.z()) / (end.z() - from.z()) * (end - from);
    hit = false;
  }
  const std::size_t at = slot(voxelOf(end.x()), voxelOf(end.y()), voxelOf(end.z()));
  const auto mark = static_cast<std::uint8_t>(hit ? kAimedAt | kSeenHit : kAimedAt);
  if ((marks_[at] & mark) == mark) return;
  if ((marks_[at] & kFrame) == 0) {
    touched_.push_back({voxelOf(end.x()), voxelOf(end.y()), voxelOf(end.z())});
  }
  marks_[at] = static_cast<std::uint8_t>(marks_[at] | mark);
  rays_.push_back({end, hit});
}

void VolumeWindow::collectRays(const DepthView& depth, const Eigen::Isometry3f& T) {
  const Intrinsics& k = depth.intrinsics();
  const double voxel = parameters_.voxel;
  // Half a voxel apart at the reach: nothing falls between.
  const auto stride = static_cast<std::uint32_t>(
      std::max(1.0, std::floor(std::min(k.fx, k.fy) * voxel / (2.0 * parameters_.reach))));
  const auto reach = static_cast<float>(parameters_.reach / voxel);
  const Eigen::Vector3f from = T.translation();
  const auto scale = static_cast<float>(1.0 / voxel);
  for (std::uint32_t v = stride / 2; v < depth.height(); v += stride) {
    const auto y = static_cast<float>((v - k.cy) / k.fy);
    const Eigen::Vector3f row = T.linear() * Eigen::Vector3f(0.0F, y, 1.0F);
    for (std::uint32_t u = stride / 2; u < depth.width(); u += stride) {
      const float z = depth.metres(v, u) * scale;
      if (!(z > 0.0F)) continue;
      const auto x = static_cast<float>((u - k.cx) / k.fx);
      const Eigen::Vector3f way = row + x * T.linear().col(0);
      const float length = z * std::sqrt(1.0F + x * x + y * y);
      const bool near = length <= reach;
      aim(from, from + (near ? z : z * reach / length) * way, near);
    }
  }
}

/// After Amanatides and Woo, as walkRay(), in three dimensions; the voxel at the end is not
/// visited.
inline void VolumeWindow::walk(const Eigen::Vector3f& from, const Ray& ray) {
  std::int32_t at[3], last[3], step[3];
  float next[3], across[3];
  std::int32_t steps = 0;
  for (int axis = 0; axis < 3; ++axis) {
    at[axis] = voxelOf(from[axis]);
    last[axis] = voxelOf(ray.end[axis]);
    const float way = ray.end[axis] - from[axis];
    step[axis] = way < 0.0F ? -1 : 1;
    across[axis] = way != 0.0F ? 1.0F / std::abs(way) : HUGE_VALF;
    const float border = static_cast<float>(at[axis] + (way < 0.0F ? 0 : 1));
    next[axis] = way != 0.0F ? std::abs(border - from[axis]) * across[axis] : HUGE_VALF;
    steps += std::abs(last[axis] - at[axis]);
  }
  for (std::int32_t i = 0; i < steps; ++i) {
    std::uint8_t& mark = marks_[slot(at[0], at[1], at[2])];
    if ((mark & kFrame) == 0) touched_.push_back({at[0], at[1], at[2]});
    mark = static_cast<std::uint8_t>(mark | kSeenFree);
    const int axis = next[0] < next[1] ? (next[0] < next[2] ? 0 : 2) : (next[1] < next[2] ? 1 : 2);
    at[axis] += step[axis];
    next[axis] += across[axis];
  }
}

void VolumeWindow::learn() {
  for (const VoxelPlace place : touched_) {
    const std::size_t at = slot(place.x, place.y, place.z);
    const unsigned mark = marks_[at];
    const auto before = static_cast<Voxel>(mark >> kJudgedShift);
    marks_[at] = static_cast<std::uint8_t>(mark & ~unsigned{kFrame});
    const bool hit = (mark & kSeenHit) != 0;
    if (!hit && (mark & kSeenFree) == 0) continue;  // the end of a ray that met nothing
    const int odds = hit ? std::min(most_, odds_[at] + hit_) : std::max(-most_, odds_[at] - miss_);
    odds_[at] = static_cast<std::int8_t>(odds);
    const Voxel judged = odds >= occupied_ ? Voxel::kOccupied
                         : odds <= -free_  ? Voxel::kFree
                                           : before;  // not sure: as it was
    if (judged == before) continue;
    marks_[at] = static_cast<std::uint8_t>(static_cast<unsigned>(judged) << kJudgedShift);
    changes_.push_back({place, judged});
  }
}

const std::vector<VolumeWindow::Change>& VolumeWindow::add(const DepthView& depth,
                                                           const Eigen::Isometry3d& T_map_optical) {
  Eigen::Isometry3f T = T_map_optical.cast<float>();
  T.translation() = (T_map_optical.translation() / parameters_.voxel).cast<float>();
  rays_.clear();
  touched_.clear();
  changes_.clear();
  collectRays(depth, T);
  for (const Ray& ray : rays_) walk(T.translation(), ray);
  learn();
  return changes_;
}

}  // namespace pilothouse
