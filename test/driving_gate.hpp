#pragma once

#include <gtest/gtest.h>

#include "bench/gate_bench.hpp"

namespace pilothouse {

/// Armed and driving.
struct Driving : GateBench {
  Driving() {
    EXPECT_TRUE(armed()) << describe(out.obstacle, "", "");
    EXPECT_EQ(tick().status, GateStatus::kRunning);
    EXPECT_EQ(out.command.vx, wanted.vx);
    EXPECT_EQ(out.command.w, wanted.w);
  }
  void expectLatched(StopCause cause) {
    EXPECT_EQ(out.status, GateStatus::kStopped);
    EXPECT_EQ(out.stopped.cause, cause) << describe(out.stopped, "", "");
    EXPECT_TRUE(out.command.zero());
  }
  /// All in good order again, but nobody arms.
  void expectHeld() {
    perception = odometry = limiter = command = true;
    for (int i = 0; i < 200; ++i) {
      EXPECT_TRUE(tick().command.zero());
      EXPECT_EQ(out.status, GateStatus::kStopped);
    }
  }
};

inline void expectInTime(double seconds) {
  EXPECT_GT(seconds, 0.2) << "a short gap is no fault";
  EXPECT_LE(seconds, 0.35);
}

}  // namespace pilothouse
