// The curves of driving: bounded, every spike kept, each change of the rule marked.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "gui/model/telemetry.hpp"

using namespace pilothouse;
using namespace pilothouse::gui;

namespace {

TEST(Trace, keepsEverySpikeInFewPoints) {
  Trace trace;
  for (int i = 0; i < 6000; ++i) trace.add(i * 0.01, i == 3333 ? 9.0 : std::sin(i * 0.01));
  std::vector<CurvePoint> points;
  trace.curve(0.0, 60.0, 300, points);
  EXPECT_LE(points.size(), 4U * 301U);
  EXPECT_GT(points.size(), 300U);
  double most = 0.0;
  double before = -1.0;
  for (const auto& p : points) {
    most = std::max(most, p.value);
    EXPECT_GE(p.t, before) << "in the order of time";
    before = p.t;
  }
  EXPECT_EQ(most, 9.0);
}

TEST(Trace, isBoundedAndForgetsTheOldest) {
  Trace trace;
  for (std::size_t i = 0; i < 3 * Trace::kCapacity; ++i) trace.add(static_cast<double>(i), 1.0);
  EXPECT_EQ(trace.size(), Trace::kCapacity);
  EXPECT_TRUE(std::isnan(trace.at(static_cast<double>(Trace::kCapacity))));
  EXPECT_EQ(trace.at(3.0 * Trace::kCapacity - 0.5), 1.0);
}

TEST(Trace, breaksWhereNothingIsKnownOrNothingCame) {
  Trace trace;
  trace.add(1.0, 0.5);
  trace.add(1.1, INFINITY);
  trace.add(1.2, 0.7);
  trace.add(1.1, 99.0);  // time never goes back
  trace.add(4.0, 0.9);
  std::vector<CurvePoint> points;
  trace.curve(0.0, 5.0, 100, points);
  int breaks = 0;
  for (const auto& p : points) breaks += std::isnan(p.value) ? 1 : 0;
  EXPECT_EQ(breaks, 2);
  EXPECT_EQ(trace.size(), 4U);
  EXPECT_TRUE(std::isnan(trace.at(3.0))) << "too old to be true";
  EXPECT_EQ(trace.at(1.25), 0.7);
  trace.curve(5.0, 5.0, 100, points);
  EXPECT_TRUE(points.empty());
}

TEST(Telemetry, marksEachChangeOfTheRuleOnceWithItsWords) {
  Telemetry telemetry;
  LimitReading limit;
  telemetry.limit(1.0, limit);
  limit.cause = LimitCause::kObstacle;
  limit.sensor = "front";
  limit.limit = 0.18;
  limit.distance = 0.62;
  telemetry.limit(2.0, limit);
  telemetry.limit(2.1, limit);
  StopReading stop;
  stop.cause = StopCause::kOperator;
  telemetry.stop(3.0, stop);
  telemetry.limit(3.1, limit);  // the gate's word counts
  stop.phase = GatePhase::kRunning;
  telemetry.stop(4.0, stop);
  telemetry.limit(4.1, limit);
  telemetry.read([](const Telemetry::Curves& curves) {
    ASSERT_EQ(curves.rules.size(), 4U);
    EXPECT_EQ(curves.rules[1].rule, Rule::kObstacle);
    EXPECT_EQ(curves.rules[1].words,
              "Slowed to 0.18 m/s: front ranger sees something 0.62 m ahead");
    EXPECT_EQ(curves.rules[2].rule, Rule::kStopped);
    EXPECT_EQ(curves.rules[3].at, 4.1);
  });
}

TEST(Telemetry, endsARuleThatNobodyReportsAnyMore) {
  Telemetry telemetry;
  LimitReading limit;
  for (int i = 0; i <= 20; ++i) telemetry.limit(1.0 + 0.05 * i, limit);
  telemetry.limit(10.0, limit);
  telemetry.read([](const Telemetry::Curves& curves) {
    ASSERT_EQ(curves.rules.size(), 2U);
    EXPECT_NEAR(curves.rules[0].until, 2.0, 1e-9) << "from here on it is not known";
    EXPECT_EQ(curves.rules[1].at, 10.0);
  });
  StopReading stop;
  stop.cause = StopCause::kOperator;
  telemetry.stop(10.1, stop);  // the gate's last word
  telemetry.limit(10.2, limit);
  telemetry.limit(11.0, limit);
  telemetry.read([](const Telemetry::Curves& curves) {
    EXPECT_EQ(curves.rules.back().rule, Rule::kFree) << "a gate that died rules no more";
    EXPECT_EQ(curves.rules.back().at, 11.0);
  });
}

TEST(Telemetry, tellsAnotherReasonUnderTheSameRuleApartButNoFigures) {
  Telemetry telemetry;
  LimitReading limit;
  limit.cause = LimitCause::kObstacle;
  limit.limit = 0.2;
  limit.sensor = "front";
  limit.distance = 0.7;
  telemetry.limit(1.0, limit);
  limit.distance = 0.64;
  telemetry.limit(1.1, limit);
  limit.sensor = "left";
  telemetry.limit(1.2, limit);
  telemetry.read([](const Telemetry::Curves& curves) {
    ASSERT_EQ(curves.rules.size(), 2U);
    EXPECT_NE(curves.rules[0].words.find("front"), std::string::npos);
    EXPECT_NE(curves.rules[1].words.find("left"), std::string::npos);
    EXPECT_EQ(curves.rules[0].until, curves.rules[1].at);
  });
}

}  // namespace
