// Millions of random steps through the stop gate: nothing that is not finite, no limit broken,
// never a command while stopped, and after a stop none before an arming.
#include <gtest/gtest.h>

#include <random>

#include "bench/gate_bench.hpp"

namespace pilothouse {
namespace {

constexpr int kSteps = 10'000'000;

/// Numbers as they should never come, now and then.
class Odd {
 public:
  explicit Odd(unsigned seed) : engine_(seed) {}
  std::uint32_t raw() { return static_cast<std::uint32_t>(engine_()); }
  bool oneIn(std::uint32_t n) { return raw() % n == 0; }
  double unit() { return static_cast<double>(raw()) / 4294967296.0; }
  double number(double good) {
    if (!oneIn(200)) return good;
    const double odd[] = {std::numeric_limits<double>::quiet_NaN(),
                          std::numeric_limits<double>::infinity(),
                          -std::numeric_limits<double>::infinity(),
                          std::numeric_limits<double>::denorm_min(),
                          -std::numeric_limits<double>::max(),
                          1e300,
                          -1.0,
                          0.0};
    return odd[raw() % std::size(odd)];
  }

 private:
  std::mt19937 engine_;
};

double oddStep(Odd& odd) {
  if (!odd.oneIn(3000)) return GateBench::kPeriod;
  const double steps[] = {0.0, -0.02, 10.0, 0.31, -100.0};
  return steps[odd.raw() % std::size(steps)];
}

void disturb(GateBench& bench, Odd& odd) {
  for (bool GateBench::*input : {&GateBench::perception, &GateBench::odometry, &GateBench::limiter,
                                 &GateBench::command, &GateBench::console})
    if (odd.oneIn(bench.*input ? 500 : 20)) bench.*input = !(bench.*input);
  if (odd.oneIn(100)) bench.source = static_cast<CommandSource>(odd.raw() % 4);
  if (odd.oneIn(10))
    bench.wanted = {odd.number(1.4 * odd.unit() - 0.7), odd.number(0.4 * odd.unit() - 0.2),
                    odd.number(3.2 * odd.unit() - 1.6)};
  if (odd.oneIn(50)) bench.wanted = {};
  if (odd.oneIn(2000)) ++bench.in.stop_requests;
  if (odd.oneIn(2000)) bench.in.other_heard = bench.now;
  if (odd.oneIn(1000)) bench.in.other_publisher = !bench.in.other_publisher && odd.oneIn(4);
  ConsoleMessage& console = bench.in.consoles[odd.raw() % kMostConsoles];
  if (odd.oneIn(300)) {
    ++console.count;
    console.slot_use = odd.raw() % 3;
    console.gate_beat = odd.raw();
    console.stamp = odd.number(console.stamp);
    console.arrival = odd.number(console.arrival);
    console.driving = odd.oneIn(2);
    console.leaving = odd.oneIn(4);
    console.stop = odd.oneIn(20);
    if (console.stop) ++console.stops;
  }
}

void spoil(GateInputs& in, Odd& odd) {
  for (Arrival* arrival : {static_cast<Arrival*>(&in.limit), static_cast<Arrival*>(&in.command),
                           static_cast<Arrival*>(&in.odometry)}) {
    if (!odd.oneIn(20)) continue;
    arrival->stamp = odd.number(arrival->stamp);
    arrival->arrival = odd.number(arrival->arrival);
  }
  in.limit.wanted = odd.number(in.limit.wanted);
  in.limit.perception_stamp = odd.number(in.limit.perception_stamp);
  in.command.off_plane = odd.oneIn(20) ? odd.number(0.0) : 0.0;
}

/// What must hold after every step.
struct Watch {
  bool armed = false;
  std::uint32_t requests = 0;
  int running = 0, stops = 0;

  void look(const GateBench& bench) {
    const GateOutput& out = bench.out;
    ASSERT_TRUE(out.command.finite());
    ASSERT_LE(out.command.linear(), 1.05 * bench.parameters.max_speed + 1e-12);
    ASSERT_LE(std::abs(out.command.w), 1.05 * bench.parameters.max_turn_rate + 1e-12);
    const bool stopped = out.status == GateStatus::kStopped;
    ASSERT_TRUE(out.status == GateStatus::kRunning || out.command.zero());
    ASSERT_EQ(stopped, out.stopped.cause != StopCause::kNone);
    ASSERT_TRUE(stopped || armed || bench.in.arm_requests != requests) << "armed by itself";
    if (stopped && armed) ++stops;
    if (out.status == GateStatus::kRunning) ++running;
    armed = !stopped;
    requests = bench.in.arm_requests;
  }
};

TEST(StopGateRandom, NothingBadEverPasses) {
  GateBench bench;
  Odd odd(7);
  Watch watch;
  for (int i = 0; i < kSteps; i += 2) {
    disturb(bench, odd);
    if (odd.oneIn(20)) ++bench.in.arm_requests;
    bench.tick(oddStep(odd));
    watch.look(bench);
    if (HasFatalFailure()) FAIL() << "step " << i;
    spoil(bench.in, odd);
    bench.in.now = {odd.number(bench.now), odd.number(bench.ros())};
    bench.out = step(bench.parameters, bench.state, bench.in);
    watch.look(bench);
    if (HasFatalFailure()) FAIL() << "spoilt step " << i;
  }
  EXPECT_GT(watch.running, kSteps / 20) << "it must drive for the test to say anything";
  EXPECT_GT(watch.stops, kSteps / 10000);
}

}  // namespace
}  // namespace pilothouse
