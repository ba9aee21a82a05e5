#include "doors/frozen_grid.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace pilothouse {
namespace {

FloorGrid grid(std::vector<float> deviations) {
  FloorGrid message;
  message.deviations = std::move(deviations);
  return message;
}
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

TEST(FrozenGrid, TheSameTwiceIsFrozenUntilItChanges) {
  FrozenGrid frozen;
  EXPECT_FALSE(frozen.repeats(grid({0.001F, 0.002F, kNan})));
  EXPECT_TRUE(frozen.repeats(grid({0.001F, 0.002F, kNan})));
  EXPECT_TRUE(frozen.repeats(grid({0.001F, 0.002F, kNan})));
  EXPECT_FALSE(frozen.repeats(grid({0.001F, 0.003F, kNan})));
}

TEST(FrozenGrid, WithoutNoiseNothingCanBeSaid) {
  FrozenGrid frozen;
  for (int i = 0; i < 3; ++i) {
    EXPECT_FALSE(frozen.repeats(grid({0.001F, kNan, 0.001F})));
    EXPECT_FALSE(frozen.repeats(grid({kNan, kNan})));
    EXPECT_FALSE(frozen.repeats(grid({})));
  }
}

TEST(FrozenGrid, AnotherSizeIsAnotherGrid) {
  FrozenGrid frozen;
  EXPECT_FALSE(frozen.repeats(grid({0.001F, 0.002F})));
  EXPECT_FALSE(frozen.repeats(grid({0.001F, 0.002F, 0.003F})));
}

}  // namespace
}  // namespace pilothouse
