// What the report of the stop evaluation lets pass.
#include "bench/stop_report.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace pilothouse::bench {
namespace {

AppearanceResult good() {
  AppearanceResult result;
  result.to_zero = 0.1;
  result.from_place = 0.12;
  result.resumed = 0.5;
  result.speed = 0.4;
  return result;
}

/// Of twenty appearances of which one is as given.
StopSummary with(const AppearanceResult& one) {
  std::vector<AppearanceResult> all(20, good());
  all.back() = one;
  return summaryOf({}, all, 0);
}

TEST(StopReport, GoodAppearancesPass) {
  EXPECT_TRUE(with(good()).pass) << with(good()).json;
}

TEST(StopReport, ACommandAfterTheZeroOrAContactFails) {
  AppearanceResult moved = good(), touched = good();
  moved.commands_after = 1;
  touched.contacts = 1;
  EXPECT_FALSE(with(moved).pass);
  EXPECT_FALSE(with(touched).pass);
  moved.stopped = touched.stopped = moved.beforehand = touched.beforehand = true;
  EXPECT_FALSE(with(moved).pass) << "also where the gate stopped";
  EXPECT_FALSE(with(touched).pass);
}

TEST(StopReport, AStopSparesOnlyWhatItSpoils) {
  AppearanceResult spoilt = good();
  spoilt.stopped = true;
  spoilt.cause = "odometry is 0.31 s old";
  spoilt.resumed = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(with(spoilt).pass) << with(spoilt).json;
  EXPECT_NE(jsonOf(spoilt, 1).find("odometry is 0.31 s old"), std::string::npos);
  spoilt.to_zero = 0.3;
  EXPECT_FALSE(with(spoilt).pass) << "it stopped after the picture: late all the same";
  spoilt.to_zero = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(with(spoilt).pass);
  spoilt.beforehand = true;
  EXPECT_TRUE(with(spoilt).pass) << with(spoilt).json;
}

TEST(StopReport, ManySpoiltFail) {
  std::vector<AppearanceResult> all(20, good());
  for (int i = 0; i < 4; ++i) all[static_cast<std::size_t>(i)].stopped = true;
  EXPECT_FALSE(summaryOf({}, all, 0).pass);
}

}  // namespace
}  // namespace pilothouse::bench
