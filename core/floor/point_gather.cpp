#include "core/floor/point_gather.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace pilothouse {
namespace {

constexpr std::size_t kPointBytes = 3 * sizeof(float);

bool isOfKind(CellClass c, PointKind kind) {
  if (c == CellClass::kUnknown) return false;
  return isDrivable(c) == (kind == PointKind::kFloor);
}

Eigen::Vector3f pointAt(const CloudView& cloud, std::uint32_t row, std::uint32_t col) {
  return cloud.point(row, col);
}

Eigen::Vector3f pointAt(const DepthView& depth, std::uint32_t row, std::uint32_t col) {
  const Intrinsics& k = depth.intrinsics();
  const float z = depth.metres(row, col);
  return {static_cast<float>((col - k.cx) / k.fx) * z, static_cast<float>((row - k.cy) / k.fy) * z,
          z};
}

template <class View>
void gather(const View& view, const std::vector<CellClass>& classes, PointKind kind,
            std::vector<std::uint8_t>& out) {
  if (classes.size() != std::size_t{view.width()} * view.height()) {
    throw std::invalid_argument("gatherPoints: " + std::to_string(classes.size()) +
                                " classes for " + std::to_string(view.width()) + "x" +
                                std::to_string(view.height()) + " points");
  }
  const auto wanted = [kind](CellClass c) { return isOfKind(c, kind); };
  out.resize(kPointBytes *
             static_cast<std::size_t>(std::count_if(classes.begin(), classes.end(), wanted)));
  std::uint8_t* next = out.data();
  std::size_t i = 0;
  for (std::uint32_t row = 0; row < view.height(); ++row) {
    for (std::uint32_t col = 0; col < view.width(); ++col) {
      if (!wanted(classes[i++])) continue;
      const Eigen::Vector3f p = pointAt(view, row, col);
      std::memcpy(next, p.data(), kPointBytes);
      next += kPointBytes;
    }
  }
}

}  // namespace

void gatherPoints(const CloudView& cloud, const std::vector<CellClass>& classes, PointKind kind,
                  std::vector<std::uint8_t>& out) {
  gather(cloud, classes, kind, out);
}

void gatherPoints(const DepthView& depth, const std::vector<CellClass>& classes, PointKind kind,
                  std::vector<std::uint8_t>& out) {
  gather(depth, classes, kind, out);
}

}  // namespace pilothouse
