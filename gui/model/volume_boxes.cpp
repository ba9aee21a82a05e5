#include "gui/model/volume_boxes.hpp"

#include <algorithm>
#include <cmath>

namespace pilothouse::gui {

namespace {

constexpr float kFarthest = 1000.0F;             // [m]
constexpr float kFloor = 0.0F, kHighest = 1.2F;  // ends of the ramp [m]
constexpr int kBits = 21;                        // of a coordinate in a key
constexpr std::int64_t kMiddle = std::int64_t{1} << (kBits - 1);
constexpr std::uint64_t kMask = (std::uint64_t{1} << kBits) - 1;

/// Of the cube that holds a point, counted in edges from the origin.
std::uint64_t keyOf(const Eigen::Vector3f& point, float edge) {
  std::uint64_t key = 0;
  for (int i = 0; i < 3; ++i) {
    const auto place = static_cast<std::int64_t>(std::floor(point[i] / edge)) + kMiddle;
    key = key << kBits | (static_cast<std::uint64_t>(place) & kMask);
  }
  return key;
}

Eigen::Vector3f middleOf(std::uint64_t key, float edge) {
  Eigen::Vector3f middle;
  for (int i = 2; i >= 0; --i) {
    const auto place = static_cast<std::int64_t>(key & kMask) - kMiddle;
    middle[i] = (static_cast<float>(place) + 0.5F) * edge;
    key >>= kBits;
  }
  return middle;
}

/// The cube of twice the edge that holds it.
std::uint64_t doubled(std::uint64_t key) {
  std::uint64_t twice = 0;
  for (int shift = 2 * kBits; shift >= 0; shift -= kBits) {
    const auto place = static_cast<std::int64_t>(key >> shift & kMask) - kMiddle;
    twice |= static_cast<std::uint64_t>((place >> 1) + kMiddle) << shift;
  }
  return twice;
}

void sortUnique(std::vector<std::uint64_t>& keys) {
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
}

}  // namespace

VolumeBoxes boxesOf(const CloudView& cloud, float edge, std::size_t most) {
  VolumeBoxes boxes;
  boxes.edge = std::max(edge, 0.002F);  // so that a kilometre fits into a key
  std::vector<std::uint64_t> keys;
  keys.reserve(cloud.points());
  for (std::uint32_t row = 0; row < cloud.height(); ++row) {
    for (std::uint32_t column = 0; column < cloud.width(); ++column) {
      const Eigen::Vector3f point = cloud.point(row, column);
      // Not so for what is not finite either.
      if (!(point.cwiseAbs().maxCoeff() < kFarthest) || !point.allFinite()) continue;
      keys.push_back(keyOf(point, boxes.edge));
    }
  }
  sortUnique(keys);
  while (keys.size() > std::max<std::size_t>(most, 8)) {
    boxes.edge *= 2.0F;
    for (std::uint64_t& key : keys) key = doubled(key);
    sortUnique(keys);
  }
  boxes.middles.reserve(keys.size());
  for (const std::uint64_t key : keys) boxes.middles.push_back(middleOf(key, boxes.edge));
  return boxes;
}

QRgb colourOfHeight(const DepthRamp& ramp, float height) {
  // The ramp is bright where it is near, and knows no distance of 0.
  constexpr float kAbove = 1.0F;
  const float share = (height - kFloor) / (kHighest - kFloor);
  const float from_above = kAbove + 1.0F - std::min(1.0F, std::max(0.0F, share));
  return ramp.colour(from_above, {kAbove, kAbove + 1.0F});
}

}  // namespace pilothouse::gui
