#include "nodelets/simulator_pace.hpp"

#include <gtest/gtest.h>

namespace pilothouse {
namespace {

using std::chrono::milliseconds;

constexpr double kTick = 0.01;
const SimulatorPace::Clock::time_point kStart =
    SimulatorPace::Clock::time_point{} + std::chrono::hours(1);

TEST(SimulatorPace, IsDueOnceATick) {
  SimulatorPace pace(1.0, kTick);
  pace.start(kStart);
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(pace.next(), kStart + milliseconds(10 * i));
    pace.ticked(pace.next() + milliseconds(3));
  }
  EXPECT_NEAR(pace.factor(), 1.0, 1e-6);
  EXPECT_EQ(pace.givenUp(), 0U);
}

TEST(SimulatorPace, RunsAtItsRate) {
  SimulatorPace pace(2.0, kTick);
  pace.start(kStart);
  for (int i = 0; i < 10; ++i) pace.ticked(pace.next());
  EXPECT_EQ(pace.next(), kStart + milliseconds(50));
  EXPECT_NEAR(pace.factor(), 2.0, 1e-6);
}

TEST(SimulatorPace, MakesUpForLateTicks) {
  SimulatorPace pace(1.0, kTick);
  pace.start(kStart);
  pace.ticked(kStart + milliseconds(200));
  EXPECT_EQ(pace.next(), kStart + milliseconds(10)) << "due long ago: at once";
  EXPECT_EQ(pace.givenUp(), 0U);
}

TEST(SimulatorPace, GivesUpWhatIsFarTooLate) {
  SimulatorPace pace(1.0, kTick);
  pace.start(kStart);
  pace.ticked(kStart + milliseconds(5000));
  EXPECT_EQ(pace.next(), kStart + milliseconds(5000));
  EXPECT_EQ(pace.givenUp(), 1U);
  EXPECT_LT(pace.factor(), 0.1);
}

TEST(SimulatorPace, WaitsForNothingAsFastAsPossible) {
  SimulatorPace pace(0.0, kTick);
  pace.start(kStart);
  for (int i = 1; i <= 10; ++i) {
    pace.ticked(kStart + milliseconds(i));
    EXPECT_LE(pace.next(), kStart);
  }
  EXPECT_NEAR(pace.factor(), 10.0, 1e-6);
}

}  // namespace
}  // namespace pilothouse
