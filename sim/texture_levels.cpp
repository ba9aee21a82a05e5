#include "sim/texture_levels.hpp"

#include <algorithm>
#include <cstring>

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

/// floor() of numbers that fit an int, without a library call.
std::int32_t whole(float x) {
  const auto cut = static_cast<std::int32_t>(x);
  return cut - (x < static_cast<float>(cut) ? 1 : 0);
}

/// Each channel of a + (b - a) * weight / 256.
std::uint32_t blend(std::uint32_t a, std::uint32_t b, std::uint32_t weight) {
  const std::uint32_t rb = (a & 0xFF00FFU) * (256U - weight) + (b & 0xFF00FFU) * weight;
  const std::uint32_t g = (a & 0x00FF00U) * (256U - weight) + (b & 0x00FF00U) * weight;
  return ((rb >> 8U) & 0xFF00FFU) | ((g >> 8U) & 0x00FF00U);
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

std::uint32_t TextureLevels::smooth(const Level& level, float x, float y) {
  x -= 0.5F;
  y -= 0.5F;
  const std::int32_t left = whole(x), top = whole(y);
  const auto right_weight = static_cast<std::uint32_t>((x - static_cast<float>(left)) * 256.0F);
  const auto low_weight = static_cast<std::uint32_t>((y - static_cast<float>(top)) * 256.0F);
  const std::uint32_t x0 = static_cast<std::uint32_t>(left) & (level.width - 1);
  const std::uint32_t x1 = (x0 + 1) & (level.width - 1);
  const std::uint32_t y0 = static_cast<std::uint32_t>(top) & (level.height - 1);
  const std::uint32_t y1 = (y0 + 1) & (level.height - 1);
  const std::uint32_t* row0 = level.texels.data() + std::size_t{y0} * level.width;
  const std::uint32_t* row1 = level.texels.data() + std::size_t{y1} * level.width;
  return blend(blend(row0[x0], row0[x1], right_weight), blend(row1[x0], row1[x1], right_weight),
               low_weight);
}

std::uint32_t TextureLevels::sample(float s, float t, float repeats_a_pixel) const {
  // Which power of two of the texels one pixel covers: the exponent of the number itself.
  const float texels = repeats_a_pixel * static_cast<float>(width());
  std::uint32_t bits;
  std::memcpy(&bits, &texels, sizeof bits);
  const int exponent = static_cast<int>((bits >> 23U) & 255U) - 127;
  const int last = static_cast<int>(levels_.size()) - 1;
  const Level& level = levels_[static_cast<std::size_t>(std::clamp(exponent, 0, last))];
  const float x = s * static_cast<float>(level.width);
  const float y = -t * static_cast<float>(level.height);
  if (exponent < 1) return smooth(level, x, y);
  const std::uint32_t column = static_cast<std::uint32_t>(whole(x)) & (level.width - 1);
  const std::uint32_t row = static_cast<std::uint32_t>(whole(y)) & (level.height - 1);
  return level.texels[std::size_t{row} * level.width + column];
}

}  // namespace pilothouse::sim
