// Driving from the console without widgets, ROS or waiting: held keys and their traps with injected
// time, the helm's messages, curves and the words for every cause.

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

#include "gui/model/clock.hpp"
#include "gui/model/conversions_drive.hpp"
#include "gui/model/drive_words.hpp"
#include "gui/model/helm.hpp"
#include "gui/model/swept_outline.hpp"
#include "gui/model/telemetry.hpp"

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

/// Keeps what the helm sends, with its time.
class Listener : public HelmOutput {
 public:
  struct Sent {
    double at;
    Beat beat;
  };
  struct Driven {
    double at;
    Twist2 command;
  };
  void beat(const Beat& beat) override {
    const std::lock_guard<std::mutex> lock(mutex_);
    beats_.push_back({steadySeconds(), beat});
    news_.notify_all();
  }
  void drive(const Twist2& command) override {
    const std::lock_guard<std::mutex> lock(mutex_);
    driven_.push_back({steadySeconds(), command});
    news_.notify_all();
  }
  template <class Condition>
  bool waitFor(Condition condition) {
    std::unique_lock<std::mutex> lock(mutex_);
    return news_.wait_for(lock, std::chrono::seconds(20),
                          [&] { return condition(beats_, driven_); });
  }
  std::vector<Sent> beats() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return beats_;
  }
  std::vector<Driven> driven() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return driven_;
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable news_;
  std::vector<Sent> beats_;
  std::vector<Driven> driven_;
};

/// A helm whose window lives as long as it is told so by another thread.
struct Afloat {
  Afloat() {
    helm.setActive(true);
    helm.windowLives();
    helm.connect(out);
    helm.start();
  }
  std::shared_ptr<Listener> out = std::make_shared<Listener>();
  Helm helm{steered()};
};

TEST(Helm, beatsStopOutAtOnceAndKeepSayingSo) {
  Afloat a;
  ASSERT_TRUE(a.out->waitFor([](auto& beats, auto&) { return beats.size() >= 5; }));
  EXPECT_FALSE(a.out->beats().back().beat.stop);
  a.helm.gateSays(77, false);
  a.helm.stop();
  ASSERT_TRUE(a.out->waitFor([](auto& beats, auto&) { return beats.back().beat.stop; }));
  const auto first = a.out->beats().size();
  ASSERT_TRUE(a.out->waitFor([&](auto& beats, auto&) { return beats.size() >= first + 3; }));
  for (std::size_t i = first; i < first + 3; ++i) {
    EXPECT_TRUE(a.out->beats()[i].beat.stop) << "latched";
    EXPECT_EQ(a.out->beats()[i].beat.gate_beat, 77U);
  }
  a.helm.release();
  ASSERT_TRUE(a.out->waitFor([](auto& beats, auto&) { return !beats.back().beat.stop; }));
}

TEST(Helm, beatsGoOnWhileTheWindowHangs) {
  Afloat a;  // windowLives() is never called again
  ASSERT_TRUE(a.out->waitFor([](auto& beats, auto&) {
    return !beats.empty() && beats.back().at - beats.front().at > 2.0 * Helm::kWindowHangs;
  }));
  for (const auto& sent : a.out->beats()) EXPECT_FALSE(sent.beat.stop || sent.beat.driving);
  EXPECT_TRUE(a.out->driven().empty());
}

TEST(Helm, aWindowThatHangsEndsDrivingWithOneZero) {
  Afloat a;
  a.helm.windowLives();
  a.helm.press(kW);
  ASSERT_TRUE(a.out->waitFor([](auto&, auto& driven) { return driven.size() >= 3; }));
  ASSERT_TRUE(a.out->waitFor([](auto&, auto& driven) { return driven.back().command.zero(); }));
  EXPECT_EQ(a.helm.view().reason, HandsOff::kWindowHangs);
  const auto count = a.out->driven().size();
  a.helm.windowLives();
  const auto beats = a.out->beats().size();
  ASSERT_TRUE(a.out->waitFor([&](auto& sent, auto&) { return sent.size() > beats + 5; }));
  EXPECT_EQ(a.out->driven().size(), count) << "the key is still down, but must be pressed anew";
}

TEST(Helm, aStopEndsDrivingAndALatchedGateHindersIt) {
  Afloat a;
  a.helm.windowLives();
  a.helm.press(kW);
  ASSERT_TRUE(a.out->waitFor([](auto&, auto& driven) { return driven.size() >= 3; }));
  a.helm.stop();
  ASSERT_TRUE(a.out->waitFor([](auto&, auto& driven) { return driven.back().command.zero(); }));
  a.helm.letGo(kW);
  a.helm.release();
  a.helm.gateSays(1, true);
  const auto count = a.out->driven().size();
  a.helm.windowLives();
  a.helm.press(kA);
  const auto beats = a.out->beats().size();
  ASSERT_TRUE(a.out->waitFor([&](auto& sent, auto&) { return sent.size() > beats + 3; }));
  EXPECT_EQ(a.out->driven().size(), count);
}

TEST(Helm, leavingSaysSoAfterALastZero) {
  Afloat a;
  a.helm.windowLives();
  a.helm.press(kW);
  ASSERT_TRUE(a.out->waitFor([](auto&, auto& driven) { return driven.size() >= 2; }));
  a.helm.leave();
  EXPECT_TRUE(a.out->driven().back().command.zero());
  EXPECT_TRUE(a.out->beats().back().beat.leaving);
  EXPECT_FALSE(a.out->beats().back().beat.driving);
}

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

LimitReading limitOf(LimitCause cause) {
  LimitReading limit;
  limit.cause = cause;
  limit.sensor = "camera";
  limit.source = "teleop";
  limit.limit = limit.limited = 0.18;
  limit.wanted = 0.4;
  limit.distance = 0.62;
  return limit;
}

TEST(Words, everyCauseOfALimit) {
  const auto words = [](LimitCause cause) { return limitWords(limitOf(cause)); };
  EXPECT_EQ(words(LimitCause::kObstacle), "Slowed to 0.18 m/s: camera sees something 0.62 m ahead");
  EXPECT_EQ(words(LimitCause::kPotential),
            "Slowed to 0.18 m/s: camera sees something beside the way 0.62 m ahead");
  EXPECT_EQ(words(LimitCause::kBraking), "Braking: camera sees something 0.62 m ahead");
  EXPECT_EQ(words(LimitCause::kThreshold), "Slowed to 0.18 m/s: a threshold 0.62 m ahead");
  EXPECT_EQ(words(LimitCause::kUnseen), "Slowed to 0.18 m/s: nothing has looked there");
  EXPECT_EQ(words(LimitCause::kBadCommand), "Stopped: the wanted command is not finite");
  auto stale = limitOf(LimitCause::kStale);
  EXPECT_EQ(limitWords(stale), "Stopped: nothing from camera yet");
  stale.input_age = 0.42;
  EXPECT_EQ(limitWords(stale), "Stopped: camera silent for 0.4 s");
  auto held = limitOf(LimitCause::kObstacle);
  held.limit = 0.0;
  held.sensor = "memory";
  held.x = -1.0;
  held.y = 0.3;
  EXPECT_EQ(limitWords(held), "Held at 0 m/s: something remembered 0.62 m behind");
  held.y = 1.3;
  EXPECT_EQ(limitWords(held), "Held at 0 m/s: something remembered 0.62 m to the left");
  auto passing = limitOf(LimitCause::kPotential);
  passing.distance = 0.0;
  passing.x = 0.1;
  passing.y = -0.4;
  EXPECT_EQ(limitWords(passing), "Slowed to 0.18 m/s: camera sees something close by on the right");
}

DriveSituation ready() {
  DriveSituation s;
  s.connected = true;
  s.now = 10.0;
  s.limit_state.ever = s.stop_state.ever = true;
  s.stop.phase = GatePhase::kRunning;
  s.limit = limitOf(LimitCause::kFree);
  return s;
}

TEST(Words, tellWhatHoldsTheRobotAndWhatToDo) {
  auto s = ready();
  EXPECT_EQ(driveWords(s).headline, "Driving by hand at 0.18 m/s");
  s.limit.wanted = 0.0;
  EXPECT_EQ(driveWords(s).headline, "Ready: nobody drives");
  s.limit = limitOf(LimitCause::kObstacle);
  EXPECT_EQ(driveWords(s).severity, Severity::kWarning);
  EXPECT_FALSE(driveWords(s).advice.empty());

  s.stop.phase = GatePhase::kStopped;
  s.stop.cause = StopCause::kOperator;
  s.stop.can_arm = true;
  EXPECT_EQ(driveWords(s).headline, "Stopped: operator's stop");
  EXPECT_EQ(driveWords(s).advice, "Hold Arm (F9) for a second to go on");
  s.stop.can_arm = false;
  s.stop.obstacle_to_arming = "odometry is 0.41 s old, limit 0.30 s";
  EXPECT_EQ(driveWords(s).advice, "Before arming: odometry is 0.41 s old, limit 0.30 s");
  s.stop.text = "perception is 0.40 s old";
  EXPECT_EQ(driveWords(s).headline, "Stopped: perception is 0.40 s old");

  s.stop_state.age_s = 3.0;
  EXPECT_EQ(driveWords(s).headline, "Stop gate silent for 3.0 s");
  s.stop_state.ever = false;
  EXPECT_EQ(driveWords(s).headline, "No stop gate: nothing can be driven from here");
  s.connected = false;
  EXPECT_EQ(driveWords(s).headline, "No robot: no ROS master answers");
}

TEST(Words, aStopThatNobodyConfirmsIsNeverShownAsDone) {
  auto s = ready();
  s.helm.stop = true;
  EXPECT_EQ(driveWords(s).headline, "Stop pressed, not confirmed by the gate yet");
  s.stop_state.ever = false;
  EXPECT_EQ(driveWords(s).headline, "Stop pressed, but no stop gate has answered yet");
}

TEST(Words, everyCauseOfAStopHasWords) {
  std::set<std::string> all;
  for (int cause = 0; cause <= 10; ++cause) {
    StopReading stop;
    stop.cause = static_cast<StopCause>(cause);
    stop.perception_age = stop.odometry_age = 0.4;
    all.insert(stopWords(stop));
  }
  EXPECT_EQ(all.size(), 11U);
  StopReading silent;
  silent.cause = StopCause::kStalePerception;
  silent.perception_age = 0.4;
  EXPECT_EQ(stopWords(silent), "Stopped: camera silent for 0.4 s");
}

TEST(Conversions, refuseWhatCannotBeDrawn) {
  SpeedLimit limit;
  limit.measured = NAN;
  limit.obstacle_distance = limit.potential_distance = INFINITY;
  EXPECT_TRUE(limitFromMessage(limit));
  limit.cause = 8;
  EXPECT_EQ(limitFromMessage(limit).reason(), "cause 8, expected 0 to 7");
  limit.cause = 0;
  limit.wanted = NAN;
  EXPECT_FALSE(limitFromMessage(limit));
  limit.wanted = 0.0F;
  limit.position.x = INFINITY;
  EXPECT_FALSE(limitFromMessage(limit));

  StopState stop;
  stop.text = "a\nb" + std::string(1000, 'x');
  ASSERT_TRUE(stopFromMessage(stop));
  EXPECT_EQ(stopFromMessage(stop)->text.size(), 160U);
  EXPECT_EQ(stopFromMessage(stop)->text.find('\n'), std::string::npos);
  stop.state = 3;
  EXPECT_FALSE(stopFromMessage(stop));
  stop.state = 0;
  stop.command.linear.x = NAN;
  EXPECT_FALSE(stopFromMessage(stop));

  sensor_msgs::JointState joints;
  joints.name = {"front_left_wheel", "front_left_steering", "_wheel"};
  EXPECT_FALSE(wheelsFromMessage(joints)) << "no velocities";
  joints.velocity = {NAN, 1.0, 2.0};
  ASSERT_TRUE(wheelsFromMessage(joints));
  ASSERT_EQ(wheelsFromMessage(joints)->size(), 1U);
  EXPECT_TRUE(std::isnan((*wheelsFromMessage(joints))[0].rate));
  joints.name.assign(65, "a_wheel");
  joints.velocity.assign(65, 0.0);
  EXPECT_FALSE(wheelsFromMessage(joints));

  sensor_msgs::Range range;
  range.max_range = 3.0F;
  range.field_of_view = 0.5F;
  range.range = 4.0F;
  EXPECT_TRUE(std::isinf(rangeFromMessage(range)->range));
  range.field_of_view = 1e9F;
  EXPECT_FALSE(rangeFromMessage(range));
}

TEST(SweptOutline, endsWhereTheFootprintIsAfterThatWay) {
  const Footprint footprint({{0.25, 0.2}, {-0.25, 0.2}, {-0.25, -0.2}, {0.25, -0.2}});
  const SweptOutline straight = sweptOutline(footprint, {0.4, 0.0, 0.0}, 2.0);
  ASSERT_GE(straight.left.size(), 2U);
  EXPECT_NEAR(straight.left.back().x(), 2.25, 1e-6);
  EXPECT_NEAR(straight.left.back().y(), 0.2, 1e-6);
  EXPECT_NEAR(straight.right.back().x(), 2.25, 1e-6);
  EXPECT_TRUE(sweptOutline(footprint, {}, 2.0).outlines.empty());
  EXPECT_TRUE(sweptOutline(footprint, {NAN, 0.0, 0.0}, 2.0).outlines.empty());
  for (const auto& outline : sweptOutline(footprint, {0.0, 0.0, 1.0}, 50.0).outlines) {
    for (const auto& p : outline) EXPECT_LT(p.norm(), 0.33) << "turning in place stays in place";
  }
}

}  // namespace
