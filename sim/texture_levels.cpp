#include "sim/texture_levels.hpp"

#include <algorithm>

namespace pilothouse::sim {
namespace {

constexpr std::uint32_t kMostSide = 1024;

std::uint32_t powerOfTwo(std::uint32_t side) {
  std::uint32_t power = 1;
  while (power < side && power < kMostSide) power *= 2;
  return power;
}

std::uint32_t average(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  std::uint32_t sum = 0;
  for (std::uint32_t shift = 0; shift < 24; shift += 8) {
    const std::uint32_t channel = ((a >> shift) & 255U) + ((b >> shift) & 255U) +
                                  ((c >> shift) & 255U) + ((d >> shift) & 255U);
    sum |= ((channel + 2U) / 4U) << shift;
  }
  return sum;
}

}  // namespace

TextureLevels::TextureLevels(const Texture& texture) {
  Level first{powerOfTwo(texture.width), powerOfTwo(texture.height), {}};
  for (std::uint32_t y = 0; y < first.height; ++y) {
    for (std::uint32_t x = 0; x < first.width; ++x) {
      const std::size_t from = 3 * (std::size_t{y} * texture.height / first.height * texture.width +
                                    std::size_t{x} * texture.width / first.width);
      first.texels.push_back(texture.rgb[from] | std::uint32_t{texture.rgb[from + 1]} << 8U |
                             std::uint32_t{texture.rgb[from + 2]} << 16U);
    }
  }
  levels_.push_back(std::move(first));
  while (levels_.back().width > 1 || levels_.back().height > 1) {
    const Level& fine = levels_.back();
    Level coarse{std::max(1U, fine.width / 2), std::max(1U, fine.height / 2), {}};
    for (std::uint32_t y = 0; y < coarse.height; ++y) {
      for (std::uint32_t x = 0; x < coarse.width; ++x) {
        const auto at = [&](std::uint32_t dx, std::uint32_t dy) {
          return fine.texels[std::size_t{std::min(2 * y + dy, fine.height - 1)} * fine.width +
                             std::min(2 * x + dx, fine.width - 1)];
        };
        coarse.texels.push_back(average(at(0, 0), at(1, 0), at(0, 1), at(1, 1)));
      }
    }
    levels_.push_back(std::move(coarse));
  }
}

}  // namespace pilothouse::sim
