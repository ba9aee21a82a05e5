#pragma once

#include <array>

#include "core/cloud/depth_view.hpp"
#include "test/fuzz/input.hpp"

namespace pilothouse {

/// A DepthBytes of arbitrary parts: width, height, step, encoding, flags, CameraInfo, then the
/// data. corpus/make_corpus.py writes the same.
struct DepthInput {
  explicit DepthInput(FuzzInput input) {
    bytes.width = input.take<std::uint32_t>();
    bytes.height = input.take<std::uint32_t>();
    bytes.step = input.take<std::uint32_t>();
    constexpr std::array<std::string_view, 5> kEncodings{"16UC1", "32FC1", "mono16", "rgb8", ""};
    bytes.encoding = kEncodings[input.take<std::uint8_t>() % kEncodings.size()];
    const auto flags = input.take<std::uint8_t>();  // 1: big endian, 2: unaligned
    bytes.is_bigendian = (flags & 1U) != 0;
    bytes.info_width = input.take<std::uint32_t>();
    bytes.info_height = input.take<std::uint32_t>();
    bytes.intrinsics.fx = input.take<double>();
    bytes.intrinsics.fy = input.take<double>();
    bytes.intrinsics.cx = input.take<double>();
    bytes.intrinsics.cy = input.take<double>();
    data = input.rest((flags & 2U) != 0 ? 1 : 0);
    bytes.data = data.data();
    bytes.size = input.left();
  }
  DepthInput(const DepthInput&) = delete;
  DepthInput& operator=(const DepthInput&) = delete;

  FuzzBytes data;
  DepthBytes bytes{};
};

}  // namespace pilothouse
