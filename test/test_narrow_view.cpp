// A robot that sees no more than a depth camera does and whose wheels slip, on drives and with
// losses of scans that differ from run to run as they do on a busy machine.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "core/pose/pose_algebra.hpp"
#include "core/pose/scan_localiser.hpp"
#include "core/pose/scan_points.hpp"
#include "registration/icp_matcher.hpp"
#include "sim/random.hpp"
#include "test/segment_room.hpp"

namespace pilothouse {
namespace {

constexpr double kView = 0.5;                   // to either side [rad]
constexpr double kNearest = 0.8, kReach = 6.0;  // [m]
constexpr int kBeams = 240;

SegmentRoom room() {
  SegmentRoom room;
  room.box(-2.95, -2.45, 5.9, 4.9);
  room.box(1.3, 1.8, 0.8, 0.6);     // a shelf
  room.box(2.15, -1.85, 0.7, 0.9);  // a chest
  room.box(-2.7, 1.6, 1.0, 0.6);    // a desk
  room.box(-2.6, -2.0, 0.5, 0.4);   // a crate
  return room;
}

/// Of a busy machine: scans that are lost, and matches that come late.
struct Load {
  double kept = 1.0;     ///< share of the scans, 15 a second
  double latest = 0.05;  ///< a match comes so late at most [s]
};

struct Errors {
  double raw = 0.0, corrected = 0.0;  ///< RMS [m]
  int accepted = 0, scans = 0;
};

class SlippingDrive {
 public:
  SlippingDrive(std::uint64_t seed, const Load& load) : random_(seed), load_(load) {}

  Errors run() {
    drive({}, 0.5);
    for (int round = 0; round < 2; ++round) {
      drive({0.25, 0.0, 0.0}, anyway(3.0));
      drive({0.15, 0.0, 0.5}, anyway(4.0));
      drive({0.0, 0.0, -0.6}, anyway(5.0));
      drive({-0.2, 0.0, 0.0}, anyway(2.0));
      drive({0.2, 0.0, 0.4}, anyway(4.0));
    }
    errors_.raw = std::sqrt(errors_.raw / tick_);
    errors_.corrected = std::sqrt(errors_.corrected / tick_);
    return errors_;
  }

 private:
  double anyway(double seconds) { return seconds * random_.uniform(0.8, 1.2); }

  void drive(const Twist2& wanted, double seconds) {
    for (const double end = now_ + seconds; now_ < end;) {
      // The base does not change its speed at once.
      twist_.vx += 0.2 * (wanted.vx - twist_.vx);
      twist_.w += 0.2 * (wanted.w - twist_.w);
      now_ = 0.02 * ++tick_;
      const Pose2 before = truth_;
      truth_ = advanced(truth_, twist_, 0.02);
      const Pose2 step = relative(before, truth_);
      wheels_ = composed(wheels_, {1.1 * step.x, 1.1 * step.y, 1.2 * step.heading});
      tracker_.addOdometry(now_, wheels_);
      errors_.raw += (wheels_.position() - truth_.position()).squaredNorm();
      errors_.corrected += (tracker_.newest().pose.position() - truth_.position()).squaredNorm();
      if (late_ && now_ >= late_->due) finish();
      if (tick_ % 3 == 0 && !late_ && random_.uniform(0.0, 1.0) < load_.kept) look();
    }
  }

  void look() {
    ScanBeams beams{now_, -kView, 2.0 * kView / kBeams, 0.0, kNearest, kReach, {}};
    for (int i = 0; i < kBeams; ++i) {
      const float range = room_.range(truth_, beams.angle_min + i * beams.angle_increment);
      beams.ranges.push_back(range * (1.0F + 0.003F * static_cast<float>(random_.normal())));
    }
    const auto points = pointsOf(beams, {}, TrackPiece({{0.0, Pose2{}}}), now_);
    late_ = Late{now_, now_ + random_.uniform(0.0, load_.latest),
                 scans_.match(points, *tracker_.at(now_))};
  }

  void finish() {
    const MatchVerdict verdict = tracker_.correct(late_->stamp, late_->match);
    scans_.learn(verdict, tracker_.at(late_->stamp)->pose);
    ++errors_.scans;
    if (verdict == MatchVerdict::kAccepted) ++errors_.accepted;
    late_.reset();
  }

  struct Late {
    double stamp, due;
    ScanMatch match;
  };
  const SegmentRoom room_ = room();
  sim::Random random_;
  Load load_;
  PoseTracker tracker_{{}};
  ScanLocaliser scans_{{}, std::make_unique<IcpMatcher>()};
  Pose2 truth_, wheels_;
  Twist2 twist_;
  int tick_ = 0;
  double now_ = 0.0;
  std::optional<Late> late_;
  Errors errors_;
};

void expectNearer(const Load& load) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Errors errors = SlippingDrive(seed, load).run();
    EXPECT_LT(errors.corrected, 0.5 * errors.raw)
        << "drive " << seed << ", " << errors.accepted << " of " << errors.scans << " accepted";
  }
}

TEST(NarrowView, KeepsItsPlaceWhileTheWheelsSlip) {
  expectNearer({});
}

TEST(NarrowView, KeepsItWhereScansAreLostAndLate) {
  expectNearer({0.3, 0.3});
}

}  // namespace
}  // namespace pilothouse
