#include "core/floor/level_scan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace pilothouse {
namespace {

constexpr int kBeams = 720;               // over the half turn ahead
constexpr float kHalfTurn = 3.14159265F;  // [rad]
constexpr std::size_t kRows = 120;        // of more, every second, third, .. is looked at
constexpr std::ptrdiff_t kNearest = 5;    // one in so many of a beam's points is nearer than
                                          // the surface that is told
constexpr int kSteps = 3;
constexpr float kDeep = 0.03F, kDeeper = 0.02F;  // of a surface: [m], and of its distance

std::uint32_t strideOf(std::uint32_t rows) {
  return static_cast<std::uint32_t>(std::max<std::size_t>(1, (rows + kRows - 1) / kRows));
}

}  // namespace

LevelScan::LevelScan(const LevelScanParameters& parameters)
    : parameters_(parameters), ends_(kBeams), ranges_(kBeams) {
  geometry_.beams = kBeams;
  geometry_.increment = kHalfTurn / kBeams;
  geometry_.angle_min = -0.5F * geometry_.increment * (kBeams - 1);
  geometry_.range_max = parameters.range_max;
}

void LevelScan::begin(std::size_t most) {
  hits_.clear();
  hits_.reserve(most);
  sorted_.reserve(most);
  std::fill(ends_.begin(), ends_.end(), 0U);
}

void LevelScan::add(const Eigen::Vector3f& point) {
  if (!(point.z() >= parameters_.low && point.z() <= parameters_.high)) return;
  const float range = std::hypot(point.x(), point.y());
  if (!(range > 0.0F && range <= parameters_.range_max && point.x() > 0.0F)) return;
  const float beam = (std::atan2(point.y(), point.x()) - geometry_.angle_min) / geometry_.increment;
  const long nearest = std::clamp(std::lround(beam), 0L, long{kBeams - 1});
  hits_.push_back({static_cast<std::uint32_t>(nearest), range});
  ++ends_[static_cast<std::size_t>(nearest)];
}

const std::vector<float>& LevelScan::end() {
  // By beam: each one's begin, which filling moves on to its end.
  std::uint32_t sum = 0;
  for (std::uint32_t& end : ends_) sum += std::exchange(end, sum);
  sorted_.resize(hits_.size());
  for (const Hit& hit : hits_) sorted_[ends_[hit.beam]++] = hit.range;
  auto first = sorted_.begin();
  for (std::size_t i = 0; i < ranges_.size(); ++i) {
    const auto last = sorted_.begin() + static_cast<std::ptrdiff_t>(ends_[i]);
    ranges_[i] = surfaceOf(first, last);
    first = last;
  }
  return ranges_;
}

float LevelScan::surfaceOf(std::vector<float>::iterator first,
                           std::vector<float>::iterator last) const {
  const auto count = last - first;
  if (count < parameters_.fewest) return std::numeric_limits<float>::quiet_NaN();
  const auto near = first + count / kNearest;
  std::nth_element(first, near, last);
  float surface = *near;
  const float depth = kDeep + kDeeper * surface;
  // From the near side of the surface to its middle.
  for (int step = 0; step < kSteps; ++step) {
    float sum = 0.0F, counted = 0.0F;
    for (auto range = first; range != last; ++range) {
      if (std::abs(*range - surface) > depth) continue;
      sum += *range;
      counted += 1.0F;
    }
    if (counted == 0.0F) break;
    surface = sum / counted;
  }
  return surface;
}

const std::vector<float>& LevelScan::scan(const DepthView& depth,
                                          const Eigen::Isometry3f& T_base_optical) {
  const Intrinsics& k = depth.intrinsics();
  const std::uint32_t stride = strideOf(depth.height());
  begin(std::size_t{depth.height() / stride + 1} * depth.width());
  const Eigen::Vector3f shift = T_base_optical.translation();
  const Eigen::Vector3f across = T_base_optical.linear().col(0);
  for (std::uint32_t row = 0; row < depth.height(); row += stride) {
    const auto y = static_cast<float>((row - k.cy) / k.fy);
    const Eigen::Vector3f middle = T_base_optical.linear() * Eigen::Vector3f(0.0F, y, 1.0F);
    for (std::uint32_t col = 0; col < depth.width(); ++col) {
      const float z = depth.metres(row, col);
      if (!(z > 0.0F)) continue;
      const auto x = static_cast<float>((col - k.cx) / k.fx);
      // Most of a picture is floor: its height alone sorts it out.
      const float height = z * (middle.z() + x * across.z()) + shift.z();
      if (!(height >= parameters_.low && height <= parameters_.high)) continue;
      add(z * (middle + x * across) + shift);
    }
  }
  return end();
}

const std::vector<float>& LevelScan::scan(const CloudView& cloud,
                                          const Eigen::Isometry3f& T_base_camera) {
  const std::uint32_t stride = strideOf(cloud.height());
  begin(std::size_t{cloud.height() / stride + 1} * cloud.width());
  for (std::uint32_t row = 0; row < cloud.height(); row += stride) {
    for (std::uint32_t col = 0; col < cloud.width(); ++col) {
      add(T_base_camera * cloud.point(row, col));
    }
  }
  return end();
}

}  // namespace pilothouse
