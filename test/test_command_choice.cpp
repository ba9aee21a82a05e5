// Whose wish is driven, and which stamps count.
#include <gtest/gtest.h>

#include <cmath>

#include "nodelets/command_choice.hpp"

namespace pilothouse {
namespace {

constexpr Twist2 kSlow{0.1, 0.0, 0.0}, kFast{0.4, 0.0, 0.0};

TEST(CommandChoice, APersonWinsWhileFresh) {
  CommandChoice choice;
  EXPECT_TRUE(choice.take(CommandChoice::kTask, kFast, 50.0, 10.0));
  EXPECT_TRUE(choice.take(CommandChoice::kTeleop, kSlow, 7.0, 10.1));
  EXPECT_STREQ(choice.choose(10.5).source, "teleop");
  EXPECT_TRUE(choice.take(CommandChoice::kTask, kFast, 50.5, 10.5));
  EXPECT_STREQ(choice.choose(10.7).source, "task") << "no word of the person for long";
}

TEST(CommandChoice, ARepeatedOrOlderStampRefreshesNothing) {
  CommandChoice choice;
  EXPECT_TRUE(choice.take(CommandChoice::kTeleop, kSlow, 7.0, 10.0));
  for (double now = 10.05; now < 10.99; now += 0.05) {
    EXPECT_FALSE(choice.take(CommandChoice::kTeleop, kFast, 7.0, now));
    EXPECT_FALSE(choice.take(CommandChoice::kTeleop, kFast, 6.9, now));
  }
  EXPECT_FALSE(choice.take(CommandChoice::kTeleop, kFast, 7.0, 60.0)) << "the same, however late";
  EXPECT_FALSE(choice.take(CommandChoice::kTeleop, kFast, 0.0, 60.0)) << "no stamp";
  EXPECT_FALSE(choice.take(CommandChoice::kTeleop, kFast, std::nan(""), 60.0));
  EXPECT_EQ(choice.choose(10.2).twist.vx, kSlow.vx);
  EXPECT_NEAR(choice.choose(10.2).age, 0.2, 1e-9);
}

TEST(CommandChoice, AClockThatWasSetBackDoesNotLockAPersonOut) {
  CommandChoice choice;
  EXPECT_TRUE(choice.take(CommandChoice::kTeleop, kSlow, 1000.0, 10.0));
  double stamp = 400.0, now = 10.0;
  while (!choice.take(CommandChoice::kTeleop, kFast, stamp += 0.05, now += 0.05)) {
    ASSERT_LT(now, 11.2);
  }
  EXPECT_GT(now, 11.0) << "not what merely came late";
  EXPECT_TRUE(choice.take(CommandChoice::kTeleop, kFast, stamp + 0.05, now + 0.05)) << "goes on";
  EXPECT_EQ(choice.choose(now + 0.05).twist.vx, kFast.vx);
}

}  // namespace
}  // namespace pilothouse
