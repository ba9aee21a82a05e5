#include "core/replay/png_header.hpp"

#include <array>
#include <cstring>
#include <string>

namespace pilothouse {
namespace {

/// Signature, length and name of the first chunk, which is always IHDR of 13 bytes.
constexpr std::array<std::uint8_t, 16> kBegin{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n',
                                              0,    0,   0,   13,  'I',  'H',  'D',  'R'};

std::uint32_t bigEndian(const std::uint8_t* b) {
  return std::uint32_t{b[0]} << 24U | std::uint32_t{b[1]} << 16U | std::uint32_t{b[2]} << 8U | b[3];
}

}  // namespace

Checked<PngHeader> parsePngHeader(const std::uint8_t* bytes, std::size_t size,
                                  const PngBounds& bounds) {
  using Result = Checked<PngHeader>;
  constexpr std::size_t kHeader = kBegin.size() + 13 + 4;  // with the checksum
  if (size < kHeader)
    return Result::refused("PNG file is " + std::to_string(size) + " bytes, expected at least " +
                           std::to_string(kHeader));
  if (std::memcmp(bytes, kBegin.data(), kBegin.size()) != 0)
    return Result::refused("PNG signature is wrong, expected a PNG file");
  PngHeader header;
  header.width = bigEndian(bytes + kBegin.size());
  header.height = bigEndian(bytes + kBegin.size() + 4);
  header.bit_depth = bytes[kBegin.size() + 8];
  header.colour_type = bytes[kBegin.size() + 9];
  const bool fits = header.width > 0 && header.height > 0 && header.width <= bounds.max_side &&
                    header.height <= bounds.max_side &&
                    std::uint64_t{header.width} * header.height <= bounds.max_pixels;
  if (!fits)
    return Result::refused("PNG size is " + std::to_string(header.width) + " x " +
                           std::to_string(header.height) + ", expected 1 to " +
                           std::to_string(bounds.max_side) + " a side and at most " +
                           std::to_string(bounds.max_pixels) + " pixels");
  return Result::of(header);
}

}  // namespace pilothouse
