// Driving from the console: held keys and their traps, with injected time.

#include <gtest/gtest.h>

#include <vector>

#include "gui/model/key_symbols.hpp"
#include "gui/model/teleop.hpp"

using namespace pilothouse;
using namespace pilothouse::gui;

namespace {

constexpr KeyMeaning kW{DriveKey::kForward, 0}, kUp{DriveKey::kForward, 1};
constexpr KeyMeaning kA{DriveKey::kTurnLeft, 0}, kQ{DriveKey::kSideLeft, 0};
constexpr KeyMeaning kShift{DriveKey::kSlow, 0};

BaseParameters steered() {
  BaseParameters base;
  base.kind = BaseKind::kFourWheelSteered;
  base.max_speed = 0.6;
  base.max_turn_rate = 1.2;
  return base;
}

/// Steps a state machine every 4 ms and keeps what it sends.
struct Driver {
  explicit Driver(const BaseParameters& base = steered()) : teleop(base) { teleop.setCap(0.3); }
  void run(double seconds, HandsOff hindrance = HandsOff::kNone) {
    for (const double end = now + seconds; now < end - 1e-9; now += 0.004) {
      if (const auto command = teleop.step(now, hindrance, moves)) {
        sent.push_back(*command);
        times.push_back(now);
      }
    }
  }
  /// What X makes of a held key: released and pressed again within a millisecond, every 40 ms.
  void runWithAutorepeat(KeyMeaning key, double seconds) {
    for (const double end = now + seconds; now < end - 1e-9;) {
      run(0.036);
      teleop.release(key, now);
      teleop.press(key, now + 0.001);
      run(0.004);
    }
  }
  int zeros() const {
    int count = 0;
    for (const auto& command : sent) count += command.zero() ? 1 : 0;
    return count;
  }

  Teleop teleop;
  bool moves = false;  ///< the limiter lets the robot move
  double now = 100.0;
  std::vector<Twist2> sent;
  std::vector<double> times;
};

// The key beside Tab: q in us, a in fr, Cyrillic in ru; Space and the arrows have one group only.
TEST(KeySymbols, areThoseOfTheActiveLayoutAndLatinWhereThatIsNot) {
  constexpr unsigned long kCyrillic = 0x6ca, kUpArrow = 0xff52;
  EXPECT_EQ(symbolIn({'q', 'a', 0, 0}, 0), 'q');
  EXPECT_EQ(symbolIn({'q', 'a', 0, 0}, 1), 'a');
  EXPECT_EQ(symbolIn({kCyrillic, 'q', 0, 0}, 1), 'q');
  EXPECT_EQ(symbolIn({kCyrillic, 'q', 0, 0}, 0), 'q');
  EXPECT_EQ(symbolIn({' ', 0, 0, 0}, 2), ' ') << "the stop key stops in every layout";
  EXPECT_EQ(symbolIn({kUpArrow, 0, 0, 0}, 1), kUpArrow);
  EXPECT_EQ(symbolIn({kCyrillic, 0, 0, 0}, 0), 0U);
}

TEST(Teleop, sendsNothingBeforeAPersonPressedSomething) {
  Driver driver;
  driver.run(2.0);
  EXPECT_TRUE(driver.sent.empty());
}

TEST(Teleop, aHeldKeyDrivesAt25HzAndItsReleaseIsOneZeroThenSilence) {
  Driver driver;
  driver.teleop.press(kW, driver.now);
  driver.run(2.0);
  EXPECT_NEAR(static_cast<double>(driver.sent.size()), 50.0, 2.0);
  EXPECT_DOUBLE_EQ(driver.sent.front().vx, 0.3);
  EXPECT_NEAR(driver.times.front(), 100.0, 0.005) << "at once, not at the next beat";
  driver.teleop.release(kW, driver.now);
  const auto before = driver.sent.size();
  driver.run(1.0);
  ASSERT_GT(driver.sent.size(), before);
  EXPECT_TRUE(driver.sent.back().zero());
  EXPECT_EQ(driver.zeros(), 1);
  EXPECT_LT(driver.times.back() - 102.0, 0.03) << "within the debounce";
}

TEST(Teleop, zerosAreRepeatedWhileTheRobotComesToRest) {
  Driver driver;
  driver.moves = true;
  driver.teleop.press(kW, driver.now);
  driver.run(0.5);
  driver.teleop.release(kW, driver.now);
  driver.run(0.8);
  EXPECT_NEAR(driver.zeros(), 20, 2) << "no command ages on the way";
  driver.moves = false;
  driver.run(0.1);
  const auto before = driver.sent.size();
  driver.moves = true;  // somebody else drives
  driver.run(1.0);
  EXPECT_EQ(driver.sent.size(), before);
  driver.teleop.press(kW, driver.now);
  driver.run(0.5);
  driver.teleop.release(kW, driver.now);
  driver.run(5.0);
  EXPECT_NEAR(driver.times.back() - (driver.now - 5.0), Teleop::kComesToRest, 0.1)
      << "never for ever, whatever the limiter says";
}

TEST(Teleop, autorepeatOfAHeldKeyNeverStutters) {
  Driver driver;
  driver.teleop.press(kW, driver.now);
  driver.runWithAutorepeat(kW, 4.0);
  EXPECT_EQ(driver.zeros(), 0);
  EXPECT_NEAR(static_cast<double>(driver.sent.size()), 100.0, 3.0);
}

TEST(Teleop, afterALostFocusTheKeyMustBePressedAnew) {
  Driver driver;
  driver.teleop.press(kW, driver.now);
  driver.run(0.5);
  driver.run(0.2, HandsOff::kFocusLost);  // the release goes to the other window
  EXPECT_TRUE(driver.sent.back().zero());
  EXPECT_EQ(driver.zeros(), 1);
  const auto before = driver.sent.size();
  driver.runWithAutorepeat(kW, 1.0);  // the focus is back, the finger never left the key
  EXPECT_EQ(driver.sent.size(), before);
  EXPECT_EQ(driver.teleop.reason(), HandsOff::kFocusLost);
  driver.teleop.release(kW, driver.now);
  driver.run(0.1);
  driver.teleop.press(kW, driver.now);
  driver.run(0.1);
  EXPECT_GT(driver.sent.size(), before);
  EXPECT_FALSE(driver.sent.back().zero());
}

TEST(Teleop, keysPressedWhileStoppedDoNotDriveLater) {
  Driver driver;
  driver.teleop.press(kW, driver.now);
  driver.run(0.5, HandsOff::kStopped);
  driver.runWithAutorepeat(kW, 0.5);  // armed meanwhile
  EXPECT_TRUE(driver.sent.empty());
}

TEST(Teleop, keysAddUpWithinTheCap) {
  Driver driver;
  driver.teleop.press(kW, driver.now);
  driver.teleop.press(kQ, driver.now);
  driver.teleop.press(kA, driver.now);
  driver.run(0.01);
  EXPECT_NEAR(driver.sent.back().linear(), 0.3, 1e-9);
  EXPECT_NEAR(driver.sent.back().vx, driver.sent.back().vy, 1e-9);
  EXPECT_NEAR(driver.sent.back().w, 0.6, 1e-9) << "half the speed, half the turn rate";
  driver.teleop.press(kShift, driver.now);
  driver.run(0.05);
  EXPECT_NEAR(driver.sent.back().linear(), 0.3 * Teleop::kSlowFactor, 1e-9);
}

TEST(Teleop, twoKeysOfOneMeaningHoldUntilBothAreLetGo) {
  Driver driver;
  driver.teleop.press(kW, driver.now);
  driver.teleop.press(kUp, driver.now);
  driver.run(0.2);
  driver.teleop.release(kW, driver.now);
  driver.run(0.2);
  EXPECT_EQ(driver.zeros(), 0);
  driver.teleop.release(kUp, driver.now);
  driver.run(0.2);
  EXPECT_EQ(driver.zeros(), 1);
}

TEST(Teleop, aDifferentialBaseDoesNotGoSideways) {
  BaseParameters base = steered();
  base.kind = BaseKind::kDifferential;
  Driver driver(base);
  driver.teleop.press(kQ, driver.now);
  driver.run(0.3);
  EXPECT_TRUE(driver.sent.empty());
}

TEST(Teleop, theStickIsBoundedAndLetGoIsZero) {
  Driver driver;
  driver.teleop.stick(Twist2{5.0, 0.0, NAN});
  driver.run(0.1);
  EXPECT_NEAR(driver.sent.back().vx, 0.3, 1e-9);
  EXPECT_EQ(driver.sent.back().w, 0.0);
  driver.teleop.stick(std::nullopt);
  driver.run(0.1);
  EXPECT_EQ(driver.zeros(), 1);
}

}  // namespace
