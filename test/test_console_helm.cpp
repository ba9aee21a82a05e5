// The helm's messages: sign of life, stop and commands on a thread that no window delays.

#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

#include "gui/model/arming.hpp"
#include "gui/model/clock.hpp"
#include "gui/model/helm.hpp"

using namespace pilothouse;
using namespace pilothouse::gui;

namespace {

constexpr KeyMeaning kW{DriveKey::kForward, 0}, kUp{DriveKey::kForward, 1};
constexpr KeyMeaning kA{DriveKey::kTurnLeft, 0};

BaseParameters steered() {
  BaseParameters base;
  base.kind = BaseKind::kFourWheelSteered;
  base.max_speed = 0.6;
  base.max_turn_rate = 1.2;
  return base;
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
    return news_.wait_for(lock, std::chrono::seconds(60),
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
  a.helm.release(a.helm.stops());
  ASSERT_TRUE(a.out->waitFor([](auto& beats, auto&) { return !beats.back().beat.stop; }));
}

TEST(Helm, aStopPressedSinceIsNotTakenBack) {
  Helm helm(steered());
  helm.stop();
  const StopSerial seen = helm.stops();
  helm.stop();
  helm.release(seen);
  EXPECT_TRUE(helm.stopped());
  helm.release(helm.stops());
  EXPECT_FALSE(helm.stopped());
  helm.release(seen);  // an old one, late
  EXPECT_FALSE(helm.stopped());
}

/// A gate that holds the robot, and what may happen while it is looked for and asked.
struct Gate : ArmService {
  Gate() { says(GatePhase::kStopped); }
  std::string find() override {
    if (while_looked_for) while_looked_for();
    return {};
  }
  std::string call() override {
    ++calls;
    return helm.stopped() ? "the operator's stop is pressed" : "";
  }
  void says(GatePhase phase) {
    auto reading = std::make_shared<StopReading>();
    reading->phase = phase;
    reading->can_arm = true;
    const double now = steadySeconds();
    state.gate.arrived(now, 1, "gate", "/stop_state");
    state.gate.deliver(Checked<std::shared_ptr<const StopReading>>::of(reading), now, 0.0);
  }
  ArmWish wish() const { return {helm.stops(), steadySeconds()}; }
  std::string arm(const ArmWish& wish) { return gui::arm(*this, state, &helm, wish); }
  ConsoleState state;
  Helm helm{steered()};
  std::function<void()> while_looked_for;
  int calls = 0;
};

TEST(Arming, takesTheStopBackAndCallsTheGate) {
  Gate gate;
  gate.helm.stop();
  EXPECT_EQ(gate.arm(gate.wish()), "");
  EXPECT_FALSE(gate.helm.stopped());
  EXPECT_EQ(gate.calls, 1);
}

TEST(Arming, neverTakesBackAStopThatWasPressedAfterItWasAskedFor) {
  Gate gate;
  const ArmWish before = gate.wish();
  gate.helm.stop();
  EXPECT_EQ(gate.arm(before), "a stop was pressed meanwhile");
  EXPECT_TRUE(gate.helm.stopped());
  gate.while_looked_for = [&] { gate.helm.stop(); };  // the master took its time
  EXPECT_EQ(gate.arm(gate.wish()), "a stop was pressed meanwhile");
  EXPECT_TRUE(gate.helm.stopped());
  EXPECT_EQ(gate.calls, 0);
}

TEST(Arming, doesNothingOnAnOldWish) {
  Gate gate;
  gate.helm.stop();
  ArmWish wish = gate.wish();
  wish.at -= 8.0;
  EXPECT_EQ(gate.arm(wish), "it took 8.0 s to reach the gate. Hold again");
  EXPECT_TRUE(gate.helm.stopped());
  EXPECT_EQ(gate.calls, 0);
}

TEST(Arming, keepsAStopThatTheGateHasNotConfirmed) {
  Gate gate;
  gate.helm.stop();
  gate.says(GatePhase::kRunning);
  EXPECT_EQ(gate.arm(gate.wish()), "the gate has not confirmed a stop");
  EXPECT_TRUE(gate.helm.stopped());
  EXPECT_EQ(gate.calls, 0);
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
  a.helm.release(a.helm.stops());
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

TEST(Helm, arrowsAimWithAToolInHandButDriveWhileSomebodyDrives) {
  Afloat a;
  a.helm.setArrowsAim(true);
  EXPECT_TRUE(a.helm.arrowsAim());
  a.helm.press(kUp);
  const auto beats = a.out->beats().size();
  ASSERT_TRUE(a.out->waitFor([&](auto& sent, auto&) { return sent.size() > beats + 3; }));
  EXPECT_TRUE(a.out->driven().empty()) << "it aims";
  // Laid down while the arrow is held: that never begins to drive.
  a.helm.setArrowsAim(false);
  a.helm.windowLives();
  a.helm.press(kUp);
  const auto later = a.out->beats().size();
  ASSERT_TRUE(a.out->waitFor([&](auto& sent, auto&) { return sent.size() > later + 3; }));
  EXPECT_TRUE(a.out->driven().empty());
  a.helm.letGo(kUp);
  // By hand already: the arrow drives with the letter.
  a.helm.setArrowsAim(true);
  a.helm.windowLives();
  a.helm.press(kW);
  ASSERT_TRUE(a.out->waitFor([](auto&, auto& driven) { return !driven.empty(); }));
  EXPECT_FALSE(a.helm.arrowsAim());
}

}  // namespace
