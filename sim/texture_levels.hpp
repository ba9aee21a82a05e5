#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

#include "sim/world.hpp"

namespace pilothouse::sim {

/// A texture and its halvings, so that what is far does not flicker. Repeats in both directions.
class TextureLevels {
 public:
  explicit TextureLevels(const Texture& texture);

  std::uint32_t width() const { return levels_.front().width; }
  /// @param s, t in repeats, t up, below 1e6. @param repeats_a_pixel chooses the level.
  /// @return 0x00BBGGRR.
  std::uint32_t sample(float s, float t, float repeats_a_pixel) const;

 private:
  struct Level {
    std::uint32_t width, height;  ///< powers of two
    std::vector<std::uint32_t> texels;
  };
  static std::int32_t whole(float x);
  static std::uint32_t blend(std::uint32_t a, std::uint32_t b, std::uint32_t weight);
  static std::uint32_t smooth(const Level& level, float x, float y);

  std::vector<Level> levels_;
};

// Here, because it is asked for each pixel.

/// floor() of numbers that fit an int, without a library call.
inline std::int32_t TextureLevels::whole(float x) {
  const auto cut = static_cast<std::int32_t>(x);
  return cut - (x < static_cast<float>(cut) ? 1 : 0);
}

/// Each channel of a + (b - a) * weight / 256.
inline std::uint32_t TextureLevels::blend(std::uint32_t a, std::uint32_t b, std::uint32_t weight) {
  const std::uint32_t rb = (a & 0xFF00FFU) * (256U - weight) + (b & 0xFF00FFU) * weight;
  const std::uint32_t g = (a & 0x00FF00U) * (256U - weight) + (b & 0x00FF00U) * weight;
  return ((rb >> 8U) & 0xFF00FFU) | ((g >> 8U) & 0x00FF00U);
}

inline std::uint32_t TextureLevels::smooth(const Level& level, float x, float y) {
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

inline std::uint32_t TextureLevels::sample(float s, float t, float repeats_a_pixel) const {
  // Which power of two of the texels one pixel covers: the exponent of the number itself.
  const float texels = repeats_a_pixel * static_cast<float>(width());
  std::uint32_t bits;
  std::memcpy(&bits, &texels, sizeof bits);
  const int exponent = static_cast<int>((bits >> 23U) & 255U) - 127;
  const int last = static_cast<int>(levels_.size()) - 1;
  const Level& level = levels_[static_cast<std::size_t>(std::clamp(exponent, 0, last))];
  const float x = s * static_cast<float>(level.width);
  const float y = -t * static_cast<float>(level.height);
  if (exponent < 0) return smooth(level, x, y);
  const std::uint32_t column = static_cast<std::uint32_t>(whole(x)) & (level.width - 1);
  const std::uint32_t row = static_cast<std::uint32_t>(whole(y)) & (level.height - 1);
  return level.texels[std::size_t{row} * level.width + column];
}

}  // namespace pilothouse::sim
