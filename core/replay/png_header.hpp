#pragma once

#include <cstddef>
#include <cstdint>

#include "core/cloud/checked.hpp"

namespace pilothouse {

/// The first chunk of a PNG file (ISO/IEC 15948), which says what a decoder will allocate.
struct PngHeader {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint8_t bit_depth = 0;    ///< bits a sample
  std::uint8_t colour_type = 0;  ///< 0 grey, 2 RGB, 3 palette, 4 grey + alpha, 6 RGB + alpha
};

/// Largest picture that is decoded: 8192 pixels a side, 2^24 pixels, as DepthBounds.
struct PngBounds {
  std::uint32_t max_side = 8192;
  std::uint64_t max_pixels = std::uint64_t{1} << 24;
};

/// Refuses, with the reason, what is no PNG or too large. @param bytes the file's beginning.
Checked<PngHeader> parsePngHeader(const std::uint8_t* bytes, std::size_t size,
                                  const PngBounds& bounds = {});

}  // namespace pilothouse
