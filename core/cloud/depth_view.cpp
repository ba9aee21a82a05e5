#include "core/cloud/depth_view.hpp"

#include <cmath>

namespace pilothouse {

Checked<DepthView> DepthView::open(const DepthBytes& bytes, const DepthBounds&) {
  DepthView view;
  view.data_ = bytes.data;
  view.width_ = bytes.width;
  view.height_ = bytes.height;
  view.step_ = bytes.step;
  view.encoding_ =
      bytes.encoding == "32FC1" ? DepthEncoding::kMetres32 : DepthEncoding::kMillimetres16;
  view.intrinsics_ = bytes.intrinsics;
  return Checked<DepthView>::of(view);
}

float DepthView::metres(std::uint32_t row_index, std::uint32_t col) const {
  if (encoding_ == DepthEncoding::kMillimetres16) {
    std::uint16_t millimetres = 0;
    std::memcpy(&millimetres, row(row_index) + std::size_t{col} * 2, 2);
    return static_cast<float>(millimetres) * 0.001F;
  }
  float metres = 0.0F;
  std::memcpy(&metres, row(row_index) + std::size_t{col} * 4, 4);
  return std::isfinite(metres) && metres > 0.0F ? metres : 0.0F;
}

}  // namespace pilothouse
