#pragma once

#include <cstdint>
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
  static std::uint32_t smooth(const Level& level, float x, float y);

  std::vector<Level> levels_;
};

}  // namespace pilothouse::sim
